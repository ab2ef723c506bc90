// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>

#include "communicator/communicator.h"
#include "output/cell_arrays.h"

namespace npfem::flow {

/// Writes the cells as a VTU file. Collective.
void write_cells(Communicator& communicator, const std::filesystem::path& path, double time_us,
                 const CellArrays& cells);

}  // namespace npfem::flow
