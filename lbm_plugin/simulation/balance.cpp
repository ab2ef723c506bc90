// SPDX-License-Identifier: MPL-2.0
#include "simulation/balance.h"

#include <algorithm>

#include "coupling/cell_population.h"
#include "immersed_boundary/stencil.h"
#include "lattice/geometry.h"

namespace npfem::flow {
namespace {

void add(PlaneWeights& weights, const Index3& node, std::int64_t work) {
  for (std::size_t axis = 0; axis < 3; ++axis) weights[axis][static_cast<std::size_t>(node[axis])] += work;
}

/// Each rank looks at its share of the planes z.
void add_fluid_nodes(PlaneWeights& weights, const Domain& domain, const Communicator& communicator) {
  const auto first_of = [&](std::int64_t rank) {
    return static_cast<int>(rank * domain.nodes[2] / communicator.size());
  };
  Index3 node{};
  for (node[2] = first_of(communicator.rank()); node[2] < first_of(communicator.rank() + 1); ++node[2]) {
    for (node[1] = 0; node[1] < domain.nodes[1]; ++node[1]) {
      for (node[0] = 0; node[0] < domain.nodes[0]; ++node[0]) {
        if (domain.node_kind(node) == kFluid) add(weights, node, 1);
      }
    }
  }
}

void add_cells(PlaneWeights& weights, const Setup& setup, std::span<const CellStart> cells,
               const Communicator& communicator) {
  const Domain& domain = setup.domain;
  const Decomposition grid(domain.nodes, domain.periodic(), 1);
  const auto share = static_cast<std::size_t>(communicator.size());
  for (std::size_t i = static_cast<std::size_t>(communicator.rank()); i < cells.size(); i += share) {
    const CellStart& cell = cells[i];
    if (cell.type < 0 || cell.type >= static_cast<int>(setup.types.size())) continue;  // refused when it is placed
    const std::vector<double> xyz = start_positions(cell, setup.types[static_cast<std::size_t>(cell.type)]);
    for (std::size_t v = 0; v + 2 < xyz.size(); v += 3) {
      const Vec3 in_nodes = scale(1.0 / domain.dx, {xyz[v], xyz[v + 1], xyz[v + 2]});
      // the cells are solved at every k-th step only
      add(weights, node_in_grid(grid, in_nodes), std::max(1, node_updates_per_vertex / setup.coupling.steps_per_solve));
    }
  }
}

}  // namespace

PlaneWeights plane_weights(const Setup& setup, std::span<const CellStart> cells, Communicator& communicator) {
  PlaneWeights weights;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    weights[axis].resize(static_cast<std::size_t>(std::max(setup.domain.nodes[axis], 0)));
  }
  add_fluid_nodes(weights, setup.domain, communicator);
  add_cells(weights, setup, cells, communicator);
  for (std::vector<std::int64_t>& axis : weights) communicator.sum(axis);
  return weights;
}

}  // namespace npfem::flow
