// SPDX-License-Identifier: MPL-2.0
#pragma once

// Where the fluid is, and what bounds it.

#include <cstdint>
#include <functional>
#include <vector>

#include "lattice/d3q19.h"

namespace npfem::flow {

// 0: fluid. t >= 1: not fluid, part of boundary number t - 1. The boundary lies half-way between a fluid node and such
// a node.
using NodeType = std::uint8_t;

inline constexpr NodeType kFluid = 0;
constexpr NodeType wall(int number) {
  return static_cast<NodeType>(number + 1);
}

// What a population meets that leaves the fluid.
struct Boundary {
  enum class Kind : std::uint8_t {
    velocity,  // a wall, at rest or moving, or an inlet: the population bounces back, with the velocity there
    pressure,  // an open face at a given pressure: fluid passes as it likes
  };
  Kind kind = Kind::velocity;
  Vec3 velocity{};               // lattice units
  double density_deviation = 0;  // rho - 1 = 3 p, of a pressure face
  // Share of `velocity` by position in node spacings, node (i, j, k) standing at (i + 1/2, j + 1/2, k + 1/2): the
  // profile of an inlet. Empty: 1.
  std::function<double(const Vec3& position)> profile{};
};

struct Geometry {
  // Type of a node by its global index. Beyond a face that is not periodic the index is -1 or the number of nodes;
  // such nodes must not be fluid. Called during set-up only.
  std::function<NodeType(int ix, int iy, int iz)> node_type;
  std::vector<Boundary> boundaries;
};

}  // namespace npfem::flow
