// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "contact/nearest_point.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// The surface of one cell at the present time.
struct CellSurface {
  int id;                         ///< global
  int type;                       ///< index into Setup::types
  std::vector<double> positions;  ///< xyz, um, unwrapped
};

/// The cells of all ranks, on every rank. Collective.
std::vector<CellSurface> all_cells(std::span<const CellType> types, Communicator& communicator,
                                   std::span<const CellSurface> own);

/// Smallest distance (um) from a vertex of one cell to the surface of another, or of its own periodic image, in the
/// whole system; negative by how far a vertex is inside another cell. Infinity where there is no other surface.
/// `own`: the cells of this rank. Looks at all pairs of cells that could be closest: for output and tests, not for
/// every step. Collective.
double smallest_cell_gap(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                         std::span<const CellSurface> own);

/// Smallest distance (um) from a vertex to a wall, negative beyond it; infinity without walls. Collective.
double smallest_wall_gap(const Domain& domain, Communicator& communicator, std::span<const CellSurface> own);

}  // namespace npfem::flow
