// SPDX-License-Identifier: MPL-2.0
#include "coupling/coupling.h"

#include <cmath>

#include "coupling/implicit_coupling.h"
#include "coupling/lineage_coupling.h"
#include "coupling/peskin_coupling.h"
#include "geometry/vec3.h"

namespace npfem::flow {

std::unique_ptr<Coupling> Coupling::create(const CoupledParts& parts) {
  if (parts.setup.coupling.scheme == CouplingScheme::peskin) return std::make_unique<PeskinCoupling>(parts);
  if (parts.setup.coupling.scheme == CouplingScheme::lineage) return std::make_unique<LineageCoupling>(parts);
  return std::make_unique<ImplicitCoupling>(parts);
}

Coupling::Coupling(const CoupledParts& parts)
    : parts_(parts), delta_(parts.setup.coupling.steps_per_solve * parts.setup.time_step) {}

void Coupling::hold_present_forces() {
  parts_.fluid.locate(parts_.cells, 0);
  parts_.fluid.sample_contact(contact_);
  parts_.cells.evaluate();
  parts_.cells.read("elastic_force", force_);
  for (std::size_t i = 0; i < force_.size(); ++i) force_[i] += contact_[i];
  parts_.cells.write("held_force", force_);
  apply_forces({});
}

void Coupling::apply_forces(const Vec3& outside) {
  parts_.fluid.apply(force_);
  book_forces(outside);
}

void Coupling::book_forces(const Vec3& outside) {
  double magnitude = 0;
  for (std::size_t v = 0; v < force_.size() / 3; ++v) {
    magnitude += norm({force_[3 * v], force_[3 * v + 1], force_[3 * v + 2]});
  }
  const double unit = parts_.units.force();
  parts_.audit.hold(parts_.lattice, add(parts_.fluid.external_force(), scale(1.0 / unit, outside)), magnitude / unit);
}

}  // namespace npfem::flow
