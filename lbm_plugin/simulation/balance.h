// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// What a vertex costs in a fluid step, in updates of a fluid node: its share of the cell solver (48 us per step of a
/// red cell of 258 vertices, docs/benchmarks.md) and of the immersed boundary (0.17 us), against 0.018 us per node on
/// one core. Only how evenly the ranks are loaded depends on it, never a result.
inline constexpr int node_updates_per_vertex = 20;

/// Where the work is: fluid nodes count 1, solid ones nothing, and every vertex of a cell, where it starts, what it
/// costs. Collective.
PlaneWeights plane_weights(const Setup& setup, Communicator& communicator);

}  // namespace npfem::flow
