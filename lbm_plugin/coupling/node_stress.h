// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "lattice/lattice.h"

namespace npfem::flow {

/// The stress of the fluid at a node, -pressure 1 + viscous, lattice units; the pressure of the density 1 left out.
struct NodeStress {
  double pressure = 0;
  SymmetricTensor viscous{};
};

inline constexpr Index3 kNoSuchNode{-1, -1, -1};

/// At fluid nodes of the grid, whichever rank holds them: the ranks ask each other. Zero for kNoSuchNode. Collective.
std::vector<NodeStress> stresses_at(std::span<const Index3> nodes, const Lattice& lattice, Communicator& communicator);

}  // namespace npfem::flow
