// SPDX-License-Identifier: MPL-2.0
#include "coupling/implicit_coupling.h"

#include <algorithm>
#include <array>

#include "coupling/ambient_mass.h"
#include "geometry/vec3.h"
#include "lattice/compensated_sum.h"

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
  parts_.fluid.locate(parts_.cells, delta_);
  parts_.fluid.sample(velocity_, contact_, stiffness_);
  parts_.cells.write("ambient_velocity", velocity_);
  parts_.cells.write("external_force", contact_);
  parts_.cells.write("contact_stiffness", stiffness_);
  const bool touches = std::any_of(stiffness_.begin(), stiffness_.end(), [](double k) { return k > 0; });
  if (touches) parts_.cells.read("velocity", before_);
  const Vec3 momentum_before = parts_.cells.solid_momentum();
  CellStepReport report = parts_.cells.step();
  const Vec3 gained = subtract(parts_.cells.solid_momentum(), momentum_before);
  parts_.cells.read("held_force", force_);
  apply_forces(subtract(touches ? given_way() : Vec3{}, scale(1.0 / delta_, gained)));
  return report;
}

/// Sum of the loads -k (x - x_n - delta v_n) = -delta k (v - v_n) by which contacts gave way within the step. Unlike
/// the contact forces themselves they do not come in pairs.
Vec3 ImplicitCoupling::given_way() {
  parts_.cells.read("velocity", velocity_);
  std::array<CompensatedSum, 3> sum;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    sum[i % 3].add(-delta_ * stiffness_[i / 3] * (velocity_[i] - before_[i]));
  }
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

}  // namespace npfem::flow
