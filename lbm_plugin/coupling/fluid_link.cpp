// SPDX-License-Identifier: MPL-2.0
#include "coupling/fluid_link.h"

#include <algorithm>

#include "coupling/stopwatch.h"
#include "geometry/vec3.h"

namespace npfem::flow {

FluidLink::FluidLink(const Setup& setup, const Units& units, Communicator& communicator, Lattice& lattice)
    : units_(units),
      lattice_(lattice),
      exchange_(communicator, lattice.decomposition(), units.dx),
      boundary_(setup.coupling.kernel_points, lattice),
      repulsion_(setup, lattice.decomposition(), lattice.nodes().own()),
      has_walls_(setup.domain.kind != DomainKind::periodic_box) {}

void FluidLink::locate(const CellPopulation& cells) {
  const Stopwatch watch(seconds_);
  cells.read("position", positions_);
  own_vertices_ = cells.vertices().size();
  exchange_.share_positions(cells.vertices(), positions_);
}

void FluidLink::interpolate() {
  lattice_.update_velocity();
  held_velocity_.resize(3 * held_count());
  boundary_.interpolate(exchange_.known().in_nodes, exchange_.known().held, held_velocity_);
  for (double& component : held_velocity_) component *= units_.velocity();
}

void FluidLink::find_contact() {
  held_contact_.resize(3 * held_count());
  repulsion_.evaluate(exchange_.known(), held_contact_);
}

void FluidLink::sample_velocity(std::vector<double>& velocity) {
  const Stopwatch watch(seconds_);
  interpolate();
  velocity.resize(3 * own_vertices_);
  exchange_.return_to_owners(held_velocity_, 3, velocity);
}

void FluidLink::sample_contact(std::vector<double>& contact) {
  const Stopwatch watch(seconds_);
  contact.assign(3 * own_vertices_, 0.0);
  if (!repulsion_.active()) return;
  find_contact();
  exchange_.return_to_owners(held_contact_, 3, contact);
}

void FluidLink::sample(std::vector<double>& velocity, std::vector<double>& contact) {
  if (!repulsion_.active()) {
    sample_contact(contact);
    return sample_velocity(velocity);
  }
  const Stopwatch watch(seconds_);
  interpolate();
  find_contact();
  held_both_.resize(6 * held_count());
  for (std::size_t h = 0; h < held_count(); ++h) {
    std::copy_n(&held_velocity_[3 * h], 3, &held_both_[6 * h]);
    std::copy_n(&held_contact_[3 * h], 3, &held_both_[6 * h + 3]);
  }
  own_both_.resize(6 * own_vertices_);
  exchange_.return_to_owners(held_both_, 6, own_both_);
  velocity.resize(3 * own_vertices_);
  contact.resize(3 * own_vertices_);
  for (std::size_t v = 0; v < own_vertices_; ++v) {
    std::copy_n(&own_both_[6 * v], 3, &velocity[3 * v]);
    std::copy_n(&own_both_[6 * v + 3], 3, &contact[3 * v]);
  }
}

void FluidLink::apply(std::span<const double> forces) {
  const Stopwatch watch(seconds_);
  exchange_.share_forces(forces, known_force_);
  for (double& component : known_force_) component /= units_.force();
  const KnownVertices& known = exchange_.known();
  lattice_.clear_force();
  boundary_.spread(known.in_nodes, known_force_);
  if (has_walls_) force_on_walls_ = boundary_.force_on_walls(known.in_nodes, known.held, known_force_);
}

Vec3 FluidLink::external_force() const {
  return subtract(scale(1.0 / units_.force(), repulsion_.force_of_walls()), force_on_walls_);
}

}  // namespace npfem::flow
