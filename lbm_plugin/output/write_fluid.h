// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>

#include "communicator/communicator.h"
#include "output/fluid_arrays.h"

namespace npfem::flow {

/// Writes the fluid as a VTI file. Collective.
void write_fluid(Communicator& communicator, const std::filesystem::path& path, double time_us,
                 const FluidArrays& fluid);

}  // namespace npfem::flow
