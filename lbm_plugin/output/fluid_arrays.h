// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "lattice/lattice.h"
#include "output/vtk_file.h"
#include "units.h"

namespace npfem::flow {

/// The fluid at one time as an image with a point at every node: velocity_um_per_us and pressure_Pa (against the mean
/// density) as Float32, flags (0: fluid, else wall). In walls velocity and pressure are 0.
struct FluidArrays {
  VtkFile file;
  Index3 nodes{};
  double dx = 0;  ///< um
  std::size_t velocity, pressure, flags;
};

FluidArrays fluid_arrays(const Lattice& lattice, const Units& units);

}  // namespace npfem::flow
