// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>

#include "communicator/communicator.h"
#include "output/cell_arrays.h"
#include "output/fluid_arrays.h"

namespace npfem::flow {

/// Temporal VTKHDF files: one HDF5 file that holds every time, after "VTKHDF format specification", version 2.0
/// (docs.vtk.org). What does not change from time to time is stored once. Rank 0 gathers and writes; a run on many
/// ranks writes VTU faster. text::FileError on every rank where a file cannot be written.

/// False in a build without HDF5, where the functions below must not be called.
bool has_vtkhdf();

/// An UnstructuredGrid of triangles. Collective.
void append_cells(Communicator& communicator, const std::filesystem::path& path, double time_us,
                  const CellArrays& cells);
/// An ImageData. Collective.
void append_fluid(Communicator& communicator, const std::filesystem::path& path, double time_us,
                  const FluidArrays& fluid);

/// Drops what a stopped run has written after that time; returns whether the file holds that very time. A file that
/// was being written when its run was killed may be unreadable: it then takes the ending .damaged, and a new one
/// begins. Used by one rank.
bool cut_vtkhdf(const std::filesystem::path& path, double time_us);

}  // namespace npfem::flow
