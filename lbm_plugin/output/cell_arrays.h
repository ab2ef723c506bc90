// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "output/vtk_file.h"
#include "simulation/setup.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// All cells at one time as a mesh of triangles. Vertices: place in um, velocity_um_per_us and force_pN (exerted on the
/// fluid). Triangles: cell_id, cell_type, and the principal stretches of the membrane against the unloaded cell. Cells
/// stand in the order of their ids, whole.
struct CellArrays {
  VtkFile file;
  std::int64_t vertices = 0, triangles = 0;
  std::size_t points, connectivity, offsets, types, velocity, force, cell_id, cell_type, larger, smaller;
};

/// Of the cells of the setup but for those that have left. With `into_box` each cell is moved by whole periods so that
/// the mean of its vertices is in the box.
CellArrays cell_arrays(const Setup& setup, std::span<const Departure> departures,
                       std::span<const CellState> local_cells, bool into_box);

}  // namespace npfem::flow
