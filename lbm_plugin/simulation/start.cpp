// SPDX-License-Identifier: MPL-2.0
#include "simulation/start.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "coupling/interior.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

void require(bool sound, const std::string& message) {
  if (!sound) throw std::invalid_argument("setup: " + message);
}

void require_positive(double value, const char* name, const char* unit) {
  require(std::isfinite(value) && value > 0,
          std::string(name) + " is " + std::to_string(value) + " " + unit + "; it must be positive and finite");
}

Vec3 couette(const Domain& domain, double y) {
  Vec3 velocity{};
  velocity[domain.flow_axis()] = domain.plate_speed * (y / domain.size()[1] - 0.5);
  return velocity;
}

/// rho nu u'' = -f between u = 0 at both plates: u = f y (H - y) / (2 rho nu).
Vec3 between_plates(const Setup& setup, double y) {
  const double speed_per_force = y * (setup.domain.size()[1] - y) / (2.0 * setup.density * setup.kinematic_viscosity);
  return {speed_per_force * setup.body_force[0], 0, speed_per_force * setup.body_force[2]};
}

/// u = f (R^2 - r^2) / (4 rho nu).
Vec3 in_tube(const Setup& setup, const Vec3& position) {
  const Vec3 from_axis = subtract(position, scale(0.5, setup.domain.size()));
  const double r2 = from_axis[0] * from_axis[0] + from_axis[1] * from_axis[1];
  const double left = setup.domain.tube_radius * setup.domain.tube_radius - r2;
  return {0, 0, setup.body_force[2] * left / (4.0 * setup.density * setup.kinematic_viscosity)};
}

Boundary boundary_of(const Opening& opening, const Domain& domain, const Units& units) {
  if (opening.kind == Opening::Kind::pressure) {
    // the pressure of the lattice is rho/3
    return {.kind = Boundary::Kind::pressure, .density_deviation = 3 * opening.pressure / units.pressure()};
  }
  const std::size_t axis = axis_of(opening.face);
  const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const auto row = static_cast<std::size_t>(domain.nodes[u]);
  return {.kind = Boundary::Kind::velocity,
          .velocity = scale(opening.mean_velocity / units.velocity(), inward(opening.face)),
          .profile = [shares = inlet_profile(domain, opening), u, v, row](int ix, int iy, int iz) {
            const std::array<int, 3> node{ix, iy, iz};
            return shares[static_cast<std::size_t>(node[u]) + row * static_cast<std::size_t>(node[v])];
          }};
}

}  // namespace

void require_sound(const Setup& setup) {
  require_positive(setup.domain.dx, "dx", "um");
  require_positive(setup.time_step, "time_step", "us");
  require_positive(setup.density, "density", "fg/um3");
  require_positive(setup.kinematic_viscosity, "kinematic_viscosity", "um2/us");
  for (const int nodes : setup.domain.nodes) {
    require(nodes >= 1, "the domain has " + std::to_string(nodes) + " nodes in one direction; at least 1 is needed");
  }
  if (setup.domain.kind == DomainKind::tube) require_positive(setup.domain.tube_radius, "tube_radius", "um");
  for (const CellType& type : setup.types) {
    const double ratio = type.interior_viscosity_ratio;
    require(std::isfinite(ratio) && ratio > 0, "cells \"" + type.name + "\" have an interior viscosity ratio of " +
                                                   std::to_string(ratio) + "; it must be positive and finite");
  }
  interior_viscosity_ratio(setup);  // refuses ratios that differ
  require(setup.coupling.steps_per_solve >= 1,
          "steps_per_solve is " + std::to_string(setup.coupling.steps_per_solve) + "; it must be at least 1");
}

Geometry lattice_geometry(const Domain& domain, const Units& units) {
  Geometry geometry;
  geometry.node_type = [domain](int ix, int iy, int iz) { return domain.node_kind({ix, iy, iz}); };
  for (std::uint8_t kind = 1; kind < first_opening_kind; ++kind) {
    geometry.boundaries.push_back({.velocity = scale(1.0 / units.velocity(), domain.wall_velocity(kind))});
  }
  for (const Opening& opening : domain.openings) geometry.boundaries.push_back(boundary_of(opening, domain, units));
  return geometry;
}

LatticeOptions lattice_options(const Setup& setup, const Units& units) {
  LatticeOptions options;
  options.tau = units.relaxation_time(setup.kinematic_viscosity);
  options.magic = setup.magic_parameter;
  options.body_force = scale(1.0 / units.force_density(), setup.body_force);
  options.collision = setup.collision;
  options.precision = setup.fluid_precision;
  options.node_force = !setup.cells.empty();
  if (has_viscosity_contrast(setup)) {
    options.inside_tau = units.relaxation_time(interior_viscosity_ratio(setup) * setup.kinematic_viscosity);
  }
  return options;
}

Vec3 developed_velocity(const Setup& setup, const Vec3& position) {
  switch (setup.domain.kind) {
    case DomainKind::shear_box:
      return couette(setup.domain, position[1]);
    case DomainKind::plates:
      return between_plates(setup, position[1]);
    case DomainKind::tube:
      return in_tube(setup, position);
    case DomainKind::periodic_box:
    case DomainKind::vessel:
      break;
  }
  return {};
}

}  // namespace npfem::flow
