// SPDX-License-Identifier: MPL-2.0
#include "coupling/coupling.h"

#include <stdexcept>
#include <utility>

#include "coupling/implicit_coupling.h"
#include "coupling/peskin_coupling.h"

namespace npfem::flow {

std::unique_ptr<Coupling> Coupling::create(const Setup& setup, ImmersedSolid& solid, Fluid& fluid) {
  if (setup.coupling.scheme == CouplingScheme::peskin) return std::make_unique<PeskinCoupling>(setup, solid, fluid);
  if (setup.coupling.scheme == CouplingScheme::lineage) {
    throw std::logic_error(
        "the coupling of the lineage needs more of the fluid than the interface has: LineageCoupling");
  }
  return std::make_unique<ImplicitCoupling>(setup, solid, fluid);
}

Coupling::Coupling(const Setup& setup, ImmersedSolid& solid, Fluid& fluid)
    : setup_(setup), solid_(solid), fluid_(fluid), delta_(setup.coupling.steps_per_solve * setup.time_step) {}

CellStepReport Coupling::advance() {
  CellStepReport report = load_fluid();
  for (int k = 0; k < setup_.coupling.steps_per_solve; ++k) {
    if (k > 0) renew_load(k);
    fluid_.step();
  }
  CellStepReport followed = follow_fluid();
  return report.cell_steps > 0 ? std::move(report) : std::move(followed);
}

void Coupling::hold_present_forces() {
  fluid_.locate(solid_, 0);
  contact_.assign(3 * solid_.vertices().size(), 0.0);
  fluid_.sample_contact(contact_);
  solid_.evaluate();
  solid_.read("elastic_force", force_);
  for (std::size_t i = 0; i < force_.size(); ++i) force_[i] += contact_[i];
  solid_.write("held_force", force_);
  fluid_.hold(force_, {});
}

}  // namespace npfem::flow
