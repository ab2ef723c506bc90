// SPDX-License-Identifier: MPL-2.0
#pragma once

// Where the fluid is, and how the walls around it move.

#include <cstdint>
#include <functional>
#include <vector>

#include "lattice/d3q19.h"

namespace npfem::flow {

// 0: fluid. t >= 1: solid, part of wall number t - 1. The wall surface lies half-way between a fluid and a solid node.
using NodeType = std::uint8_t;

inline constexpr NodeType kFluid = 0;
constexpr NodeType wall(int number) {
  return static_cast<NodeType>(number + 1);
}

struct Geometry {
  // Type of a node by its global index. Beyond a face that is not periodic the index is -1 or the number of nodes;
  // such nodes must be solid. Called during set-up only.
  std::function<NodeType(int ix, int iy, int iz)> node_type;
  // Velocity of each wall, lattice units; zero for a wall at rest.
  std::vector<Vec3> wall_velocity;
};

}  // namespace npfem::flow
