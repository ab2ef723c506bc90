// SPDX-License-Identifier: MPL-2.0
#include "coupling/peskin_coupling.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace npfem::flow {

PeskinCoupling::PeskinCoupling(const CoupledParts& parts) : Coupling(parts) {
  if (!parts.cells.has_solid_mass()) return;
  throw std::invalid_argument(
      "coupling \"peskin\": a material gives its cells mass of their own (membrane_density or solid_density), which an "
      "explicit scheme cannot carry; use coupling \"implicit\" or set the density to 0");
}

CellStepReport PeskinCoupling::load_fluid() {
  hold_present_forces();
  return {};
}

CellStepReport PeskinCoupling::follow_fluid() {
  parts_.fluid.sample_velocity(velocity_);
  parts_.cells.read("position", position_);
  CellStepReport report;
  for (const CellPopulation::Cell& cell : parts_.cells.cells()) {
    ++report.cell_steps;
    if (follow(cell)) continue;
    report.failures.push_back({cell.id, cell.type,
                               "the explicit coupling is unstable here: the fluid would carry a vertex beyond the "
                               "size of the whole domain in one step, or its velocity is not finite"});
  }
  parts_.cells.write("position", position_);
  parts_.cells.write("velocity", velocity_);
  return report;
}

/// False, and the cell stays where it is, where the flow at its vertices makes no sense.
bool PeskinCoupling::follow(const CellPopulation::Cell& cell) {
  const Vec3 size = parts_.setup.domain.size();
  const double farthest = std::max({size[0], size[1], size[2]});
  const std::size_t first = 3 * cell.first_vertex;
  const std::size_t last = first + 3 * parts_.cells.vertices_of(cell.type);
  for (std::size_t i = first; i < last; ++i) {
    if (std::abs(delta_ * velocity_[i]) <= farthest) continue;
    std::fill(velocity_.begin() + static_cast<std::ptrdiff_t>(first),
              velocity_.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
    return false;
  }
  for (std::size_t i = first; i < last; ++i) position_[i] += delta_ * velocity_[i];
  return true;
}

}  // namespace npfem::flow
