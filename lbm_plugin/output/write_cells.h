// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "simulation/setup.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// Writes all cells at one time as a VTU file of triangles. Vertices: Float64 in um, velocity_um_per_us and force_pN
/// (exerted on the fluid). Triangles: cell_id, cell_type, and the principal stretches of the membrane against the
/// unloaded cell. Cells stand in the order of their ids, whole; with
/// `into_box` each is moved by whole periods so that the mean of its vertices is in the box. Collective.
void write_cells(Communicator& communicator, const std::filesystem::path& path, double time_us, const Setup& setup,
                 std::span<const CellState> local_cells, bool into_box);

}  // namespace npfem::flow
