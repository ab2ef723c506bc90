// SPDX-License-Identifier: MPL-2.0
#include <cmath>
#include <numbers>

#include "quantity.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"
#include "units.h"

namespace npfem::flow {
namespace {

using text::format_quantity;
using text::Key;
using text::Table;

constexpr double largest_tau = 50;

/// Steady flow of the plain fluid: u(middle) = factor * G, mean = share * u(middle), wall shear rate = slope * G.
struct SteadyFlow {
  double centre_per_gradient, mean_share, wall_rate_per_gradient;
};

SteadyFlow poiseuille(const Domain& domain, double dynamic_viscosity) {
  if (domain.kind == DomainKind::tube) {
    const double r = domain.tube_radius;
    return {r * r / (4 * dynamic_viscosity), 0.5, r / (2 * dynamic_viscosity)};
  }
  const double h = domain.size()[1];
  return {h * h / (8 * dynamic_viscosity), 2.0 / 3.0, h / (2 * dynamic_viscosity)};
}

void read_pressure_driven(const Table& table, Scene& scene) {
  Setup& setup = scene.setup;
  const text::Key* drive = one_of(table, {&keys::mean_velocity, &keys::centre_velocity, &keys::pressure_gradient});
  if (!drive) return;
  const SteadyFlow flow = poiseuille(setup.domain, setup.density * setup.kinematic_viscosity);
  double gradient = table.quantity(*drive);
  if (drive == &keys::mean_velocity) gradient /= flow.mean_share * flow.centre_per_gradient;
  if (drive == &keys::centre_velocity) gradient /= flow.centre_per_gradient;
  setup.body_force[setup.domain.kind == DomainKind::tube ? 2 : 0] = gradient;
  scene.largest_velocity = gradient * flow.centre_per_gradient;
  scene.largest_shear_rate = gradient * flow.wall_rate_per_gradient;
}

/// The lattice fluid is compressible: its speed of sound is dx/(sqrt 3 dt).
void require_low_mach(const Table& table, const Scene& scene) {
  constexpr double largest_mach = 0.3;
  const double sound = scene.setup.domain.dx / scene.setup.time_step / std::numbers::sqrt3;
  const double mach = scene.largest_velocity / sound;
  if (mach <= largest_mach) return;
  table.fail("the largest velocity, " + format_quantity(rounded(scene.largest_velocity), "mm/s") + ", is Mach " +
             text::format_number(rounded(mach)) + " on the lattice, above 0.3: take a time step below " +
             format_quantity(rounded(scene.setup.time_step * largest_mach / mach), "us"));
}

}  // namespace

void read_fluid(const text::Table& table, Setup& setup) {
  setup.density = table.quantity(keys::density);
  const Key& viscosity = exactly_one_of(table, {&keys::kinematic_viscosity, &keys::dynamic_viscosity});
  setup.kinematic_viscosity =
      &viscosity == &keys::kinematic_viscosity ? table.quantity(viscosity) : table.quantity(viscosity) / setup.density;
  setup.magic_parameter = table.quantity(keys::magic_parameter);

  const double dx = setup.domain.dx;
  const Key& clock = exactly_one_of(table, {&keys::time_step, &keys::tau});
  double tau = 0;
  if (&clock == &keys::tau) {
    tau = table.quantity(keys::tau);
    if (!(tau > 0.5)) table.fail("tau", text::format_number(tau) + " must be greater than 0.5");
    setup.time_step = (tau - 0.5) / 3 * dx * dx / setup.kinematic_viscosity;
  } else {
    setup.time_step = table.quantity(keys::time_step);
    tau = Units{dx, setup.time_step, setup.density}.relaxation_time(setup.kinematic_viscosity);
  }
  if (tau > largest_tau) {
    table.fail(clock.name,
               "gives a relaxation time of " + text::format_number(rounded(tau)) + " steps, above " +
                   text::format_number(largest_tau) + ": take a time step below " +
                   format_quantity(rounded((largest_tau - 0.5) / 3 * dx * dx / setup.kinematic_viscosity), "us"));
  }
}

void read_flow(const text::Table& table, Scene& scene) {
  Setup& setup = scene.setup;
  const DomainKind kind = setup.domain.kind;
  setup.start_developed = table.choice(keys::start) == "developed";
  const auto driven = {&keys::mean_velocity, &keys::centre_velocity, &keys::pressure_gradient};
  if (kind == DomainKind::shear_box) {
    refuse(table, driven, "a shear box is driven by \"shear_rate\"; for a pressure-driven flow take the kind plates");
    const double rate = table.quantity(keys::shear_rate);
    setup.domain.plate_speed = rate * setup.domain.size()[1];
    scene.largest_velocity = 0.5 * setup.domain.plate_speed;
    scene.largest_shear_rate = rate;
  } else if (kind == DomainKind::periodic_box) {
    refuse(table, {&keys::shear_rate, &keys::mean_velocity, &keys::centre_velocity, &keys::pressure_gradient},
           "a periodic box has no walls to drive a flow against; take the kind shear_box, plates or tube");
  } else {
    refuse(table, {&keys::shear_rate},
           "only a shear box has this; give mean_velocity, centre_velocity or "
           "pressure_gradient");
    read_pressure_driven(table, scene);
  }
  require_low_mach(table, scene);
}

}  // namespace npfem::flow
