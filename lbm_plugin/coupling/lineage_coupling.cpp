// SPDX-License-Identifier: MPL-2.0
#include "coupling/lineage_coupling.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/vec3.h"
#include "geometry/vertex_patches.h"

namespace npfem::flow {

LineageCoupling::LineageCoupling(const CoupledParts& parts)
    : Coupling(parts), traction_(parts.setup, parts.units, parts.communicator, parts.lattice) {
  for (const CellType& type : parts.setup.types) {
    const std::vector<double> masses = type.model->get("solid_mass");
    if (std::all_of(masses.begin(), masses.end(), [](double mass) { return mass > 0; })) continue;
    throw std::invalid_argument("coupling \"lineage\": cells \"" + type.name +
                                "\" have vertices without mass of their own, which this scheme moves by; give their "
                                "material a solid_density, as palabos-rbc has, or use coupling \"implicit\"");
  }
}

CellStepReport LineageCoupling::load_fluid() {
  CellPopulation& cells = parts_.cells;
  parts_.fluid.locate(cells, delta_);
  parts_.fluid.sample_contact(contact_);
  parts_.fluid.sample_crowding(crowded_);
  cells.read("position", position_);
  cells.read("velocity", velocity_);
  traction_.sample(cells, position_, crowded_, external_);
  for (std::size_t i = 0; i < external_.size(); ++i) external_[i] += contact_[i];
  cells.write("external_force", external_);
  force_.assign(external_.size(), 0.0);
  cells.write("held_force", force_);  // it is no force of the cell
  const Vec3 momentum_before = cells.solid_momentum();
  CellStepReport report = cells.step();
  const Vec3 gained = subtract(cells.solid_momentum(), momentum_before);
  force_fluid();
  cells.write("held_force", force_);
  book_forces(scale(-1.0 / delta_, gained));
  return report;
}

/// The vertices are on their way to where the step has brought them, at the velocity it has given them.
void LineageCoupling::renew_load(int steps_since_solve) {
  parts_.cells.read("position", position_);
  parts_.cells.read("velocity", velocity_);
  const double remaining = delta_ - steps_since_solve * parts_.setup.time_step;
  for (std::size_t i = 0; i < position_.size(); ++i) position_[i] -= remaining * velocity_[i];
  parts_.fluid.locate_at(parts_.cells, position_);
  force_fluid();
}

/// With vertices at position_ moving at velocity_; leaves the sum over the iterations in force_.
void LineageCoupling::force_fluid() {
  const Setup& setup = parts_.setup;
  const double per_area = setup.density * setup.domain.dx / setup.time_step;
  force_.assign(position_.size(), 0.0);
  parts_.lattice.clear_force();
  for (int iteration = 0; iteration < setup.coupling.forcing_iterations; ++iteration) {
    parts_.fluid.sample_velocity(fluid_velocity_);
    for (const CellPopulation::Cell& cell : parts_.cells.cells()) {
      const std::size_t first = 3 * cell.first_vertex;
      const auto positions = std::span(position_).subspan(first, 3 * parts_.cells.vertices_of(cell.type));
      const auto patches = vertex_patches(positions, setup.types[static_cast<std::size_t>(cell.type)].triangles);
      for (std::size_t i = 0; i < positions.size(); ++i) {
        force_[first + i] += per_area * patches[i / 3].area * (velocity_[first + i] - fluid_velocity_[first + i]);
      }
    }
    parts_.fluid.apply(force_);
  }
}

}  // namespace npfem::flow
