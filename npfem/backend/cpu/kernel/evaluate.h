// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/carver.h"
#include "backend/cpu/kernel/cell_fields.h"

namespace npfem::NPFEM_ISA {

/// Elastic forces (pN) and energies (pN um) of W cells at their present positions.
template <class Shape>
void evaluate(const cpu::EvaluateTask<double>& task) {
  using P = typename Shape::P;
  using Fields = CellFields<Shape, double>;
  constexpr int cells = Shape::cells;
  const int n = task.plan->num_vertices, length = Shape::length(n);
  Carver memory(task.workspace);
  P* const position = memory.take<P>(length);
  P* const gradient = memory.take<P>(length);
  P* const area_gradient = memory.take<P>(length);
  P* const volume_gradient = memory.take<P>(length);
  const Fields fields(task.block, task.first_lane, n, task.plan->is_translation_invariant);
  for (int i = 0; i < 3 * n; ++i) {
    for (int l = 0; l < cells; ++l)
      Fields::row(position, i)[l] = fields.from(task.block.position, i)[l] - fields.centre[i % 3][l];
  }
  for (int i = 0; i < length; ++i) gradient[i] = P(0.0);
  P energies[cpu::num_energies];
  for (P& e : energies) e = P(0.0);
  Shape::forces(*task.plan, position, gradient, area_gradient, volume_gradient, energies);
  for (int i = 0; i < 3 * n; ++i) {
    for (int l = 0; l < cells; ++l) fields.from(task.elastic_force, i)[l] = -Fields::row(gradient, i)[l];
  }
  for (int e = 0; e < cpu::num_energies; ++e) {
    for (int l = 0; l < cells; ++l) fields.from(task.energies, e)[l] = energies[e][l];
  }
}

}  // namespace npfem::NPFEM_ISA
