// SPDX-License-Identifier: MPL-2.0
#include "coupling/implicit_coupling.h"

#include <algorithm>
#include <array>

#include "geometry/vec3.h"
#include "lattice/compensated_sum.h"

namespace npfem::flow {

ImplicitCoupling::ImplicitCoupling(const Setup& setup, ImmersedSolid& solid, Fluid& fluid)
    : Coupling(setup, solid, fluid) {
  solid_.carry_fluid([this](std::span<const double> areas) { return fluid_.ambient_masses(areas, delta_); });
}

CellStepReport ImplicitCoupling::load_fluid() {
  const std::size_t vertices = solid_.vertices().size();
  velocity_.resize(3 * vertices);
  contact_.assign(3 * vertices, 0.0);
  stiffness_.assign(vertices, 0.0);
  fluid_.locate(solid_, delta_);
  fluid_.sample(velocity_, contact_, stiffness_);
  solid_.write("ambient_velocity", velocity_);
  solid_.write("external_force", contact_);
  solid_.write("contact_stiffness", stiffness_);
  const bool touches = std::any_of(stiffness_.begin(), stiffness_.end(), [](double k) { return k > 0; });
  if (touches) solid_.read("velocity", before_);
  const Vec3 momentum_before = solid_.solid_momentum();
  CellStepReport report = solid_.step();
  const Vec3 gained = subtract(solid_.solid_momentum(), momentum_before);
  solid_.read("held_force", force_);
  const Vec3 loads = add(solid_.own_loads(), touches ? given_way() : Vec3{});
  fluid_.hold(force_, subtract(loads, scale(1.0 / delta_, gained)));
  return report;
}

/// Sum of the loads -k (x - x_n - delta v_n) = -delta k (v - v_n) by which contacts gave way within the step. Unlike
/// the contact forces themselves they do not come in pairs.
Vec3 ImplicitCoupling::given_way() {
  solid_.read("velocity", velocity_);
  std::array<CompensatedSum, 3> sum;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    sum[i % 3].add(-delta_ * stiffness_[i / 3] * (velocity_[i] - before_[i]));
  }
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

}  // namespace npfem::flow
