// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "communicator/communicator.h"
#include "geometry/domain.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// Mean thickness (um) of the layer along the walls that cells leave free: the walls are divided into patches of about
/// 2 um by 2 um, each has the distance of the nearest vertex in front of it, and the mean is over the patches with a
/// cell in front. After the edge of the cell core of Fedosov, Caswell, Popel & Karniadakis, Microcirculation 17 (2010)
/// 615, by patches instead of one line of sight. NaN without walls or cells. Collective; the same for any number of
/// ranks.
double cell_free_layer(const Domain& domain, std::span<const CellState> local_cells, Communicator& communicator);

}  // namespace npfem::flow
