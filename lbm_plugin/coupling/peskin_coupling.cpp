// SPDX-License-Identifier: MPL-2.0
#include "coupling/peskin_coupling.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace npfem::flow {

PeskinCoupling::PeskinCoupling(const Setup& setup, ImmersedSolid& solid, Fluid& fluid) : Coupling(setup, solid, fluid) {
  if (!solid.has_solid_mass()) return;
  throw std::invalid_argument(
      "coupling \"peskin\": a material gives its cells mass of their own (membrane_density or solid_density), which an "
      "explicit scheme cannot carry; use coupling \"implicit\" or set the density to 0");
}

CellStepReport PeskinCoupling::load_fluid() {
  hold_present_forces();
  return {};
}

CellStepReport PeskinCoupling::follow_fluid() {
  velocity_.resize(3 * solid_.vertices().size());
  fluid_.sample_velocity(velocity_);
  solid_.read("position", position_);
  CellStepReport report;
  for_each_body(solid_.vertices(), [&](int id, std::size_t first, std::size_t count) {
    ++report.cell_steps;
    if (follow(3 * first, 3 * count)) return;
    report.failures.push_back({id, setup_.cells[static_cast<std::size_t>(id)].type,
                               "the explicit coupling is unstable here: the fluid would carry a vertex beyond the "
                               "size of the whole domain in one step, or its velocity is not finite"});
  });
  solid_.write("position", position_);
  solid_.write("velocity", velocity_);
  return report;
}

/// The coordinates of one body. False, and it stays where it is, where the flow at its vertices makes no sense.
bool PeskinCoupling::follow(std::size_t first, std::size_t count) {
  const Vec3 size = setup_.domain.size();
  const double farthest = std::max({size[0], size[1], size[2]});
  const auto speeds = std::span(velocity_).subspan(first, count);
  if (!std::all_of(speeds.begin(), speeds.end(), [&](double v) { return std::abs(delta_ * v) <= farthest; })) {
    std::fill(speeds.begin(), speeds.end(), 0.0);
    return false;
  }
  for (std::size_t i = first; i < first + count; ++i) position_[i] += delta_ * velocity_[i];
  return true;
}

}  // namespace npfem::flow
