// SPDX-License-Identifier: MPL-2.0
#include "coupling/implicit_coupling.h"

#include "coupling/ambient_mass.h"
#include "geometry/vec3.h"

namespace npfem::flow {

ImplicitCoupling::ImplicitCoupling(const CoupledParts& parts) : Coupling(parts) {
  const Setup& setup = parts.setup;
  for (std::size_t type = 0; type < setup.types.size(); ++type) {
    const std::vector<double> areas = setup.types[type].model->get("rest_area");
    parts_.cells.set_ambient_mass(
        static_cast<int>(type),
        ambient_masses(areas, setup.coupling.kernel_points, parts.units, setup.kinematic_viscosity, delta_));
  }
}

CellStepReport ImplicitCoupling::load_fluid() {
  parts_.fluid.locate(parts_.cells);
  parts_.fluid.sample(velocity_, contact_);
  parts_.cells.write("ambient_velocity", velocity_);
  parts_.cells.write("external_force", contact_);
  const Vec3 momentum_before = parts_.cells.solid_momentum();
  CellStepReport report = parts_.cells.step();
  const Vec3 gained = subtract(parts_.cells.solid_momentum(), momentum_before);
  parts_.cells.read("held_force", force_);
  apply_forces(scale(1.0 / delta_, gained));
  return report;
}

}  // namespace npfem::flow
