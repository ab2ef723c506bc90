// SPDX-License-Identifier: MPL-2.0
#include "coupling/fluid_link.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/ambient_mass.h"
#include "coupling/crowding.h"
#include "coupling/stopwatch.h"
#include "geometry/vec3.h"

namespace npfem::flow {

namespace {

double longest_edge(const Setup& setup, std::span<const VertexId> vertices, std::span<const double> xyz) {
  double square = 0;
  for_each_body(vertices, [&](int id, std::size_t first, std::size_t /*count*/) {
    const double* const x = xyz.data() + 3 * first;
    const auto type = static_cast<std::size_t>(setup.cells[static_cast<std::size_t>(id)].type);
    const std::vector<std::int32_t>& triangles = setup.types[type].triangles;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const double* const a = x + 3 * triangles[i];
      const double* const b = x + 3 * triangles[i % 3 == 2 ? i - 2 : i + 1];
      const Vec3 edge{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      square = std::max(square, dot(edge, edge));
    }
  });
  return std::sqrt(square);
}

double fastest(std::span<const double> velocities) {
  double square = 0;
  for (std::size_t i = 0; i < velocities.size(); i += 3) {
    const Vec3 v{velocities[i], velocities[i + 1], velocities[i + 2]};
    square = std::max(square, dot(v, v));
  }
  return std::sqrt(square);
}

/// A solid that is not made of cells of the setup has no surface that the link knows of.
double inset_in_nodes(const Setup& setup) {
  const CouplingSettings& coupling = setup.coupling;
  if (coupling.scheme == CouplingScheme::lineage || setup.cells.empty()) return 0;
  return coupling.inset.value_or(kernel_excess(coupling.kernel_points));
}

}  // namespace

FluidLink::FluidLink(const Setup& setup, const Units& units, Communicator& communicator, Lattice& lattice,
                     MomentumAudit& audit)
    : units_(units),
      lattice_(lattice),
      exchange_(communicator, lattice.decomposition(), units.dx),
      boundary_(setup.coupling.kernel_points, lattice),
      inset_(setup, inset_in_nodes(setup) * units.dx),
      contacts_(setup),
      setup_(setup),
      has_walls_(setup.domain.has_walls()),
      communicator_(communicator),
      audit_(audit) {}

std::vector<double> FluidLink::ambient_masses(std::span<const double> rest_areas, double delta) const {
  return flow::ambient_masses(rest_areas, setup_.coupling.kernel_points, units_, setup_.kinematic_viscosity, delta);
}

void FluidLink::locate(const ImmersedSolid& solid, double delta) {
  const Stopwatch watch(seconds_.exchange);
  solid.read("position", positions_);
  solid.read("velocity", velocities_);
  expected_.resize(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) expected_[i] = positions_[i] + delta * velocities_[i];
  own_vertices_ = solid.vertices().size();
  exchange_.share_positions(solid.vertices(), inset_.place(solid.vertices(), positions_), expected_,
                            contact_reach(solid, delta));
}

void FluidLink::locate_at(const ImmersedSolid& solid, std::span<const double> positions) {
  const Stopwatch watch(seconds_.exchange);
  own_vertices_ = solid.vertices().size();
  exchange_.share_positions(solid.vertices(), positions, positions, 0);
}

/// Nodes from a held vertex to the farthest corner of a triangle that it may touch: their greatest distance when the
/// contacts act, and what both have moved until then. The longest edge and the greatest speed of the whole system are
/// exact on every rank, so no stretched triangle is overlooked.
int FluidLink::contact_reach(const ImmersedSolid& solid, double delta) {
  if (!(contacts_.reach() > 0) || communicator_.size() == 1) return 0;
  std::array<double, 2> largest{longest_edge(setup_, solid.vertices(), expected_), fastest(velocities_)};
  communicator_.maximum(largest);
  const double nodes = (contacts_.reach() + largest[0] + 2 * delta * largest[1] + inset_.depth()) / units_.dx;
  const Index3& all = lattice_.decomposition().nodes();
  return static_cast<int>(std::min(std::ceil(nodes), static_cast<double>(*std::max_element(all.begin(), all.end()))));
}

void FluidLink::interpolate() {
  {
    const Stopwatch watch(seconds_.velocity);
    lattice_.update_velocity();
  }
  const Stopwatch watch(seconds_.interpolation);
  held_velocity_.resize(3 * held_count());
  boundary_.interpolate(exchange_.known().in_nodes, exchange_.known().held, held_velocity_);
  for (double& component : held_velocity_) component *= units_.velocity();
}

void FluidLink::find_contacts() {
  const Stopwatch watch(seconds_.contacts);
  found_.resize(exchange_.contact_vertices().id.size());
  contacts_.evaluate(exchange_.contact_vertices(), found_);
  const Contacts::Finding finding = contacts_.finding();
  if (finding.contacts > 0) least_contact_distance_ = std::min(least_contact_distance_, finding.least_distance);
  own_.resize(own_vertices_);
}

void FluidLink::take_forces(std::span<double> contact) const {
  for (std::size_t i = 0; i < contact.size(); ++i) contact[i] = force_of(own_[i / 3].force[i % 3]);
}

void FluidLink::sample_velocity(std::span<double> velocity) {
  interpolate();
  const Stopwatch watch(seconds_.exchange);
  exchange_.return_to_owners(held_velocity_, 3, velocity);
  inset_.to_vertices(velocity);
}

void FluidLink::sample_contact(std::span<double> contact) {
  if (!contacts_.active()) return;
  find_contacts();
  const Stopwatch watch(seconds_.exchange);
  exchange_.return_to_owners({}, 0, {}, found_, own_);
  take_forces(contact);
}

void FluidLink::sample_crowding(std::span<double> crowded) {
  const Stopwatch watch(seconds_.contacts);
  exchange_.return_to_owners(crowded_vertices(exchange_.known(), lattice_.decomposition(), setup_.domain), 1, crowded);
}

void FluidLink::sample(std::span<double> velocity, std::span<double> contact, std::span<double> stiffness) {
  if (!contacts_.active()) return sample_velocity(velocity);
  interpolate();
  find_contacts();
  const Stopwatch watch(seconds_.exchange);
  exchange_.return_to_owners(held_velocity_, 3, velocity, found_, own_);
  inset_.to_vertices(velocity);
  take_forces(contact);
  for (std::size_t v = 0; v < own_vertices_; ++v) stiffness[v] = stiffness_of(own_[v].stiffness);
}

void FluidLink::hold(std::span<const double> forces, const Vec3& outside) {
  spread(forces);
  double magnitude = 0;
  for (std::size_t i = 0; i < forces.size(); i += 3) magnitude += norm({forces[i], forces[i + 1], forces[i + 2]});
  const double unit = units_.force();
  audit_.hold(lattice_, add(external_force(), scale(1.0 / unit, outside)), magnitude / unit);
}

void FluidLink::spread(std::span<const double> forces) {
  {
    const Stopwatch watch(seconds_.exchange);
    at_markers_.assign(forces.begin(), forces.end());
    inset_.to_markers(at_markers_);
    exchange_.share_forces(at_markers_, known_force_);
  }
  const Stopwatch watch(seconds_.spreading);
  for (double& component : known_force_) component /= units_.force();
  const KnownVertices& known = exchange_.known();
  lattice_.clear_force();
  boundary_.spread(known.in_nodes, known_force_);
  if (has_walls_) force_on_walls_ = boundary_.force_on_walls(known.in_nodes, known.held, known_force_);
}

void FluidLink::step() {
  lattice_.step();
  audit_.count_step(lattice_);
}

/// This rank's share of what came from outside the suspension with the last sample and hold: contact with walls less
/// the force spread on solid nodes. Lattice units.
Vec3 FluidLink::external_force() const {
  return subtract(scale(1.0 / units_.force(), contacts_.force_of_walls()), force_on_walls_);
}

}  // namespace npfem::flow
