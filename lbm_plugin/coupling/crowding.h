// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "communicator/decomposition.h"
#include "coupling/vertex_exchange.h"
#include "geometry/domain.h"

namespace npfem::flow {

/// Of the vertices held by this rank, which have a vertex of another cell, or a wall, within one node spacing: 1 or 0
/// each.
std::vector<double> crowded_vertices(const KnownVertices& known, const Decomposition& decomposition,
                                     const Domain& domain);

}  // namespace npfem::flow
