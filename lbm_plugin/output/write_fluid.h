// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>

#include "communicator/communicator.h"
#include "lattice/lattice.h"
#include "units.h"

namespace npfem::flow {

/// Writes the fluid at one time as a VTI image with a point at every node: velocity_um_per_us and pressure_Pa (against
/// the mean density) as Float32, flags (0: fluid, else wall). In walls velocity and pressure are 0. Collective.
void write_fluid(Communicator& communicator, const std::filesystem::path& path, double time_us, const Lattice& lattice,
                 const Units& units);

}  // namespace npfem::flow
