// SPDX-License-Identifier: MPL-2.0
#include "coupling/lineage_coupling.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/vec3.h"
#include "geometry/vertex_patches.h"

namespace npfem::flow {

LineageCoupling::LineageCoupling(const Setup& setup, CellPopulation& cells, FluidLink& fluid, OuterTraction traction)
    : Coupling(setup, cells, fluid), cells_(cells), lattice_(fluid), traction_(std::move(traction)) {
  for (const CellType& type : setup.types) {
    const std::vector<double> masses = type.model->get("solid_mass");
    if (std::all_of(masses.begin(), masses.end(), [](double mass) { return mass > 0; })) continue;
    throw std::invalid_argument("coupling \"lineage\": cells \"" + type.name +
                                "\" have vertices without mass of their own, which this scheme moves by; give their "
                                "material a solid_density, as palabos-rbc has, or use coupling \"implicit\"");
  }
}

CellStepReport LineageCoupling::load_fluid() {
  lattice_.locate(cells_, delta_);
  contact_.assign(3 * cells_.vertices().size(), 0.0);
  lattice_.sample_contact(contact_);
  crowded_.resize(cells_.vertices().size());
  lattice_.sample_crowding(crowded_);
  cells_.read("position", position_);
  cells_.read("velocity", velocity_);
  traction_.sample(cells_, position_, crowded_, external_);
  for (std::size_t i = 0; i < external_.size(); ++i) external_[i] += contact_[i];
  cells_.write("external_force", external_);
  force_.assign(external_.size(), 0.0);
  cells_.write("held_force", force_);  // it is no force of the cell
  const Vec3 momentum_before = cells_.solid_momentum();
  CellStepReport report = cells_.step();
  outside_ = scale(-1.0 / delta_, subtract(cells_.solid_momentum(), momentum_before));
  force_fluid();
  cells_.write("held_force", force_);
  return report;
}

/// The vertices are on their way to where the step has brought them, at the velocity it has given them.
void LineageCoupling::renew_load(int steps_since_solve) {
  cells_.read("position", position_);
  cells_.read("velocity", velocity_);
  const double remaining = delta_ - steps_since_solve * setup_.time_step;
  for (std::size_t i = 0; i < position_.size(); ++i) position_[i] -= remaining * velocity_[i];
  lattice_.locate_at(cells_, position_);
  force_fluid();
}

/// With vertices at position_ moving at velocity_; leaves the sum over the iterations in force_.
void LineageCoupling::force_fluid() {
  const double per_area = setup_.density * setup_.domain.dx / setup_.time_step;
  force_.assign(position_.size(), 0.0);
  fluid_velocity_.resize(position_.size());
  lattice_.hold(force_, outside_);
  for (int iteration = 0; iteration < setup_.coupling.forcing_iterations; ++iteration) {
    lattice_.sample_velocity(fluid_velocity_);
    for (const CellPopulation::Cell& cell : cells_.cells()) {
      const std::size_t first = 3 * cell.first_vertex;
      const auto positions = std::span(position_).subspan(first, 3 * cells_.vertices_of(cell.type));
      const auto patches = vertex_patches(positions, setup_.types[static_cast<std::size_t>(cell.type)].triangles);
      for (std::size_t i = 0; i < positions.size(); ++i) {
        force_[first + i] += per_area * patches[i / 3].area * (velocity_[first + i] - fluid_velocity_[first + i]);
      }
    }
    lattice_.hold(force_, outside_);
  }
}

}  // namespace npfem::flow
