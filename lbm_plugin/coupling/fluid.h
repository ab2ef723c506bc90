// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "coupling/immersed_solid.h"
#include "geometry/vec3.h"

namespace npfem::flow {

/// What a coupling asks of the fluid around a solid: the lattice of this plugin (FluidLink) or any other. Vertex data
/// are xyz per own vertex of the solid, in um, us, pN. All calls are collective.
class Fluid {
 public:
  virtual ~Fluid() = default;

  /// The mass of fluid (fg) that moves with vertices of these rest areas (um2) when forces on them change at once and
  /// are held for `delta` (us). It holds density, viscosity and spacing of the fluid; see ambient_mass.h.
  virtual std::vector<double> ambient_masses(std::span<const double> rest_areas, double delta) const = 0;

  /// The calls below use the present positions of the vertices until the next locate(), wherever these move meanwhile:
  /// velocity and force meet at the same place. Contacts act where the vertices would be after `delta` (us) at their
  /// present velocities.
  virtual void locate(const ImmersedSolid& solid, double delta) = 0;

  /// Velocity of the fluid at the vertices, with half of the force that it holds.
  virtual void sample_velocity(std::span<double> velocity) = 0;
  /// Forces of contacts between bodies and with walls, where there are any; given as zeros.
  virtual void sample_contact(std::span<double> /*contact*/) {}
  /// Both at once, and the stiffness of the contacts, one number per vertex, pN/um; given as zeros.
  virtual void sample(std::span<double> velocity, std::span<double> /*contact*/, std::span<double> /*stiffness*/) {
    sample_velocity(velocity);
  }

  /// Makes the fluid hold these forces of the vertices, in place of those before, from now on. `outside`: what the
  /// solid gives it of loads from outside the suspension, so that the momentum of all can be audited.
  virtual void hold(std::span<const double> forces, const Vec3& outside) = 0;

  /// Advances by one time step of the fluid.
  virtual void step() = 0;
};

}  // namespace npfem::flow
