// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "geometry/bounds.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// The surface of one cell at the present time.
struct CellSurface {
  int id;                         ///< global
  int type;                       ///< index into Setup::types
  std::vector<double> positions;  ///< xyz, um, unwrapped
};

Bounds bounds_of(const CellSurface& cell);

/// What lies around one rank: its own cells and those of others whose boxes come within reach of the box around its
/// own, in any periodic image; in order of id, positions bit for bit those of their owners.
struct Surroundings {
  std::vector<CellSurface> cells;
  std::vector<bool> is_own;  ///< by cell
};

/// Every rank sends each of its cells to the ranks it is near to: a rank holds what surrounds it, not the system, as
/// long as its own cells lie together in less than half a period. Collective.
Surroundings surroundings(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                          std::span<const CellSurface> own, double reach);

}  // namespace npfem::flow
