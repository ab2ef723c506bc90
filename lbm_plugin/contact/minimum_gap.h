// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "communicator/communicator.h"
#include "contact/near_cells.h"
#include "contact/nearest_point.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// Smallest distance (um) from a vertex of one cell to the surface of another, or of its own periodic image, in the
/// whole system; negative by how far a vertex is inside another cell. Infinity where there is no other surface.
/// `own`: the cells of this rank. Looks at all pairs of cells that could be closest: for output and tests, not for
/// every step. A rank is sent what surrounds it, as far as the gap is wide. Collective.
double smallest_cell_gap(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                         std::span<const CellSurface> own);

/// Smallest distance (um) from a vertex to a wall, negative beyond it; infinity without walls. Collective.
double smallest_wall_gap(const Domain& domain, Communicator& communicator, std::span<const CellSurface> own);

}  // namespace npfem::flow
