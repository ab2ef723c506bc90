// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "communicator/communicator.h"
#include "lattice/lattice.h"

namespace npfem::flow {

/// Force that each wall or inlet has exerted on the fluid in the last step, by number of the boundary, lattice units,
/// without the pressure of the density 1. A population that has bounced came back as f_-i = f_i - 6 w_i c_i . u_wall,
/// and gave the fluid -c_i (f_i + f_-i) = -c_i (2 f_-i + 6 w_i c_i . u_wall) (Ladd, J. Fluid Mech. 271 (1994) 285). The
/// same bits for any number of ranks. Collective.
std::vector<Vec3> wall_forces(const Lattice& lattice, Communicator& communicator);

}  // namespace npfem::flow
