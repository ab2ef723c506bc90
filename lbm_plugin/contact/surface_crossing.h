// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "contact/near_cells.h"
#include "contact/nearest_point.h"

namespace npfem::flow {

/// Does the segment from p to q pass through the triangle? Where it only touches its plane or an edge, either answer.
bool segment_crosses(const Vec3& p, const Vec3& q, const Corners& triangle);

/// How many pairs of triangles of different cells, or of a cell and its own image, pass through each other in the whole
/// system: two closed surfaces can cross by their edges alone, without a vertex of one inside the other. `own`: the
/// cells of this rank. Collective.
std::int64_t count_crossings(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                             std::span<const CellSurface> own);

}  // namespace npfem::flow
