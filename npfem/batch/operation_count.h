// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cell_status.h"
#include "backend/solver_options.h"
#include "batch/counted.h"
#include "model/model.h"

namespace npfem {

/// Floating-point operations of the parts of a step of one cell: each addition, multiplication, division and root is
/// one (a fused multiply-add is two). Counted by running the energies themselves on numbers that count (counted.h), and
/// from the nonzeros of the factors. What is shared by all cells, such as products of moduli, is not counted.
struct OperationCount {
  double unknowns;      ///< 3 for each vertex
  double elastic;       ///< all elastic energies and their gradient, with the additions at the vertices
  double viscous;       ///< the same of the incremental dissipation
  double scalar_solve;  ///< x, y and z with the factor of the scalar weights
  double block_solve;   ///< with the factor of the 3 x 3 blocks, the turn to the rest shape and back, the global terms
  double weigh;         ///< product of x, y and z with the weights (damping of the lineage)
};

/// Corners of an element as numbers that count on `counter`.
template <std::size_t N>
void counted_corners(const std::array<int, N>& vertices, const std::vector<Point>& position, long& counter,
                     Vec3<Counted> (&x)[N]) {
  for (std::size_t i = 0; i < N; ++i) {
    const Point& p = position[static_cast<std::size_t>(vertices[i])];
    x[i] = {{p[0], counter}, {p[1], counter}, {p[2], counter}};
  }
}

/// Of one evaluation of an energy with its gradient on one element of the model. No energy branches, so it is the same
/// for all elements and all shapes.
template <class E>
long count_element(const Model& model) {
  const ElementBlock<E>& block = model.block<E>();
  long counter = 0;
  Vec3<Counted> x[E::num_vertices], gradient[E::num_vertices];
  counted_corners(block.vertices.front(), model.initial, counter, x);
  E::energy_gradient(x, block.rest.front(), block.params.front(), gradient);
  return counter;
}

/// The membrane laws upon one triangle share its strain, as they do in the back end cpu.
OperationCount count_operations(const Model& model);

/// Of a whole step that ended with the given report. Work done once per vertex and step (prediction, new velocities,
/// choice of the matrix) is left out: it is some per cent, and the count errs to the low side.
double operations_of_step(const OperationCount& count, const SolverOptions& options, const CellReport& report);

}  // namespace npfem
