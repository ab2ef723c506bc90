// SPDX-License-Identifier: MPL-2.0
#pragma once

// The inner loops of the immersed boundary, compiled once per instruction set. No multiply and add are fused and every
// contribution is rounded alike wherever it is computed: the bits do not depend on the processor, ranks or threads.

#include <cstddef>
#include <cstdint>

#include "lattice/kernels.h"
#include "lattice/node_map.h"

namespace npfem::flow {

// Where the nodes of a rank are (NodeMap), in plain numbers.
struct NodeTable {
  const std::int32_t* strips;  // of the first row of the halo; rows along y, then z
  std::ptrdiff_t row, plane;   // entries from row to row along y and along z
  int begin[3];                // first own node, global
  int size[3];                 // own nodes
  int period[3];               // nodes after which a direction repeats itself; 0: it does not

  NodeTable(const Decomposition& decomposition, const NodeMap& nodes);
};

// Positions are in node spacings, forces and velocities in lattice units, xyzxyz...; `vectors` of the nodes likewise,
// by node number.
template <class Real>
struct Transfer {
  // velocities[3 i] = velocity at positions[3 which[i]], for vertices whose node this rank holds.
  void (*interpolate)(const NodeTable& nodes, const Real* vectors, const double* positions, const int* which,
                      std::ptrdiff_t count, double* velocities);
  // Adds the forces of all vertices, in their order, to own nodes with z_begin <= iz < z_end.
  void (*spread)(const NodeTable& nodes, Real* vectors, const double* positions, const double* forces,
                 std::ptrdiff_t count, int z_begin, int z_end);
};

// points: 2, 3 or 4.
template <class Real>
const Transfer<Real>& transfer(InstructionSet instruction_set, int points);

}  // namespace npfem::flow
