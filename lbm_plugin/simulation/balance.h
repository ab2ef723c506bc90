// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// What a vertex costs in a step of the cells, in updates of a fluid node: measured on blood at 35 % (suite `coupled`,
/// docs/benchmarks.md, one core, double), 0.9 us for cell solver, immersed boundary, contacts and exchange of a vertex
/// against 0.022 us per node. Only how evenly the ranks are loaded depends on it, never a result.
inline constexpr int node_updates_per_vertex = 40;

/// Where the work is: fluid nodes count 1, solid ones nothing, and every vertex of the cells, which are those of the
/// setup or where they have come to, what it costs. Collective.
PlaneWeights plane_weights(const Setup& setup, std::span<const CellStart> cells, Communicator& communicator);

}  // namespace npfem::flow
