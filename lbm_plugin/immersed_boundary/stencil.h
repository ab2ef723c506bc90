// SPDX-License-Identifier: MPL-2.0
#pragma once

// Where a vertex stands among the nodes. Positions are in node spacings: node i stands at i + 1/2. Indices are
// unwrapped; only integers are ever carried around a periodic direction, so that the weights have the same bits on
// every rank.

#include <algorithm>
#include <array>
#include <cmath>

#include "communicator/decomposition.h"
#include "immersed_boundary/kernel.h"
#include "lattice/d3q19.h"

namespace npfem::flow {

/// A floored position as an index, for positions that are finite; out of the range of int it stays at the end of it.
[[gnu::always_inline]] inline int index_of(double floored) {
  return static_cast<int>(floored < -1e9 ? -1e9 : (floored > 1e9 ? 1e9 : floored));
}

/// The node whose unit cube holds the position, unwrapped.
inline Index3 node_at(const Vec3& position) {
  return {index_of(std::floor(position[0])), index_of(std::floor(position[1])), index_of(std::floor(position[2]))};
}

/// The node of the grid that stands for an unwrapped one: carried around where the direction is periodic, the nearest
/// one for a position beyond a wall.
inline int node_in_grid(const Decomposition& decomposition, int axis, int node) {
  return std::clamp(decomposition.wrap(axis, node), 0, decomposition.nodes()[static_cast<std::size_t>(axis)] - 1);
}

inline Index3 node_in_grid(const Decomposition& decomposition, const Vec3& position) {
  const Index3 node = node_at(position);
  return {node_in_grid(decomposition, 0, node[0]), node_in_grid(decomposition, 1, node[1]),
          node_in_grid(decomposition, 2, node[2])};
}

/// The nodes that a vertex exchanges velocity and force with: Points^3 of them from `first` upwards, the weight of each
/// the product of three. All lie within two nodes of node_at(position).
template <int Points>
struct Stencil {
  Index3 first;
  std::array<std::array<double, Points>, 3> weight;

  [[gnu::always_inline]] explicit Stencil(const Vec3& position) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from_node_zero = position[axis] - 0.5;
      // Three points: the nearest node. Two or four: the nearest node below.
      const double anchor = std::floor(Points == 3 ? position[axis] : from_node_zero);
      first[axis] = index_of(anchor) - (Points - 1) / 2;
      weight[axis] = Kernel<Points>::weights(from_node_zero - anchor);
    }
  }
};

}  // namespace npfem::flow
