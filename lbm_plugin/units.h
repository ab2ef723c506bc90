// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem::flow {

/// The one place where lattice units (node spacing, time step and density are 1) meet um, us and fg.
///
/// Each factor is the size of one lattice unit: physical = factor * lattice.
struct Units {
  double dx;       ///< um, node spacing
  double dt;       ///< us, time step of the fluid
  double density;  ///< fg/um3

  double velocity() const { return dx / dt; }                            ///< um/us
  double mass() const { return density * dx * dx * dx; }                 ///< fg
  double force() const { return mass() * dx / (dt * dt); }               ///< pN = fg um/us2
  double force_density() const { return density * dx / (dt * dt); }      ///< pN/um3
  double pressure() const { return density * velocity() * velocity(); }  ///< Pa = fg/(um us2)
  double kinematic_viscosity() const { return dx * dx / dt; }            ///< um2/us
  double impulse() const { return mass() * velocity(); }                 ///< pN us

  /// Relaxation time tau, in time steps, of a lattice fluid of that kinematic viscosity (um2/us): nu = (tau - 1/2)/3.
  double relaxation_time(double viscosity) const { return 0.5 + 3.0 * viscosity / kinematic_viscosity(); }
};

}  // namespace npfem::flow
