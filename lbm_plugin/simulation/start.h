// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "lattice/lattice.h"
#include "simulation/setup.h"
#include "units.h"

namespace npfem::flow {

/// std::invalid_argument where the numbers of a setup make no sense, saying which and what is allowed.
void require_sound(const Setup& setup);

/// The walls of the domain as the lattice sees them.
Geometry lattice_geometry(const Domain& domain, const Units& units);

LatticeOptions lattice_options(const Setup& setup, const Units& units);

/// Velocity (um/us) of the steady flow without cells: Couette between the plates of a shear box, Poiseuille between
/// plates at rest and in a tube, driven by the body force along the walls. No flow in a periodic box.
Vec3 developed_velocity(const Setup& setup, const Vec3& position);

}  // namespace npfem::flow
