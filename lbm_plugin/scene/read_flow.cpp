// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <cmath>
#include <limits>
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

/// In a vessel: that of a tube as wide as the box across the flow.
SteadyFlow poiseuille(const Domain& domain, double dynamic_viscosity) {
  if (domain.kind == DomainKind::tube || domain.kind == DomainKind::vessel) {
    const std::size_t along = domain.flow_axis();
    const double r = domain.kind == DomainKind::tube
                         ? domain.tube_radius
                         : 0.5 * std::min(domain.size()[(along + 1) % 3], domain.size()[(along + 2) % 3]);
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
  setup.body_force[setup.domain.flow_axis()] = gradient;
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
  const std::string collision = table.choice(keys::collision);
  setup.collision = collision == "trt" ? Collision::trt : collision == "bgk" ? Collision::bgk : Collision::regularised;
  setup.magic_parameter = table.quantity(keys::magic_parameter);
  const bool in_double = table.choice(keys::fluid_precision) == "double";
  setup.fluid_precision = in_double ? FluidPrecision::in_double : FluidPrecision::in_float;

  const double dx = setup.domain.dx;
  const Key& clock = exactly_one_of(table, {&keys::time_step, &keys::tau});
  double tau = 0;
  if (&clock == &keys::tau) {
    tau = table.quantity(keys::tau);
    if (!(tau > 0.5)) table.fail("tau", text::format_number(tau) + " must be greater than 0.5");
    setup.time_step = (tau - 0.5) / 3 * dx * dx / setup.kinematic_viscosity;
  } else {
    setup.time_step = table.quantity(keys::time_step);
  }
  // of the numbers as they are used: a viscosity may be too small beside 1/2, or a time step beyond all numbers
  tau = Units{dx, setup.time_step, setup.density}.relaxation_time(setup.kinematic_viscosity);
  if (!(tau > 0.5) || !std::isfinite(setup.time_step)) {
    table.fail(viscosity.name,
               "with a density of " + format_quantity(setup.density, "kg/m3") + " and a time step of " +
                   format_quantity(rounded(setup.time_step), "us") +
                   " the relaxation time of the lattice is no more than 1/2 step, where the viscosity is zero: is the "
                   "density, the viscosity or the time step mistyped?");
  }
  if (tau > largest_tau) {
    table.fail(clock.name,
               "gives a relaxation time of " + text::format_number(rounded(tau)) + " steps, above " +
                   text::format_number(largest_tau) + ": take a time step below " +
                   format_quantity(rounded((largest_tau - 0.5) / 3 * dx * dx / setup.kinematic_viscosity), "us"));
  }
}

namespace {

void require_not_driven(const Table& table, const std::string& reason) {
  refuse(table, {&keys::mean_velocity, &keys::centre_velocity, &keys::pressure_gradient}, reason);
}

/// Estimates how fast the flow through the openings will be, and requires their pressures to be small for the lattice.
void assess_openings(const Table& root, Scene& scene) {
  const Setup& setup = scene.setup;
  const Domain& domain = setup.domain;
  constexpr double largest_deviation = 0.1;  // of the density
  const double unit = Units{domain.dx, setup.time_step, setup.density}.pressure();
  const std::vector<Table> tables = root.tables("openings");
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  for (std::size_t n = 0; n < tables.size(); ++n) {
    const Opening& opening = domain.openings[n];
    const std::vector<double> shares = inlet_profile(domain, opening);
    if (std::none_of(shares.begin(), shares.end(), [](double share) { return share > 0; })) {
      tables[n].fail("face", "the walls leave nothing of this face open");
    }
    if (opening.kind == Opening::Kind::velocity) {
      const double fastest = std::abs(opening.mean_velocity) * *std::max_element(shares.begin(), shares.end());
      scene.largest_velocity = std::max(scene.largest_velocity, fastest);
      continue;
    }
    const double deviation = 3 * std::abs(opening.pressure) / unit * setup.waveform.largest();
    if (deviation > largest_deviation) {
      tables[n].fail("pressure",
                     format_quantity(opening.pressure, "Pa") + " changes the density of the lattice fluid by " +
                         text::format_rounded(100 * deviation) + " %, above 10 %: take a time step below " +
                         format_quantity(rounded(setup.time_step * std::sqrt(largest_deviation / deviation)), "us"));
    }
    highest = std::max(highest, opening.pressure);
    lowest = std::min(lowest, opening.pressure);
  }
  if (highest > lowest) {
    const SteadyFlow flow = poiseuille(domain, setup.density * setup.kinematic_viscosity);
    const double gradient = (highest - lowest) / domain.size()[domain.flow_axis()];
    scene.largest_velocity = std::max(scene.largest_velocity, gradient * flow.centre_per_gradient);
    scene.largest_shear_rate = gradient * flow.wall_rate_per_gradient;
  }
}

/// The flow to start from is known where nothing but plates or a tube bounds it.
void require_known_flow(const Table& table, const Domain& domain) {
  if (domain.openings.empty() && domain.solids.empty()) return;
  table.fail("start", "a developed flow is known only without openings and solids; take \"rest\"");
}

}  // namespace

void read_flow(const text::Table& root, Scene& scene) {
  const Table table = root.table("flow");
  Setup& setup = scene.setup;
  const Domain& domain = setup.domain;
  if (table.has("waveform")) setup.waveform = read_waveform(table.table("waveform"));
  setup.start_developed = table.choice(keys::start) == "developed";
  if (setup.start_developed) require_known_flow(table, domain);
  if (domain.kind == DomainKind::shear_box) {
    require_not_driven(table,
                       "a shear box is driven by \"shear_rate\"; for a pressure-driven flow take the kind plates");
    const double rate = table.quantity(keys::shear_rate);
    setup.domain.plate_speed = rate * domain.size()[1];
    scene.largest_velocity = 0.5 * domain.plate_speed;
    scene.largest_shear_rate = rate;
  } else if (!domain.openings.empty()) {
    refuse(table, {&keys::shear_rate}, "only a shear box has this");
    require_not_driven(table, "the openings drive the flow; take this out or them");
  } else if (domain.kind == DomainKind::periodic_box && domain.solids.empty()) {
    refuse(table, {&keys::shear_rate, &keys::mean_velocity, &keys::centre_velocity, &keys::pressure_gradient},
           "a periodic box has no walls to drive a flow against; take the kind shear_box, plates or tube");
  } else {
    refuse(table, {&keys::shear_rate},
           "only a shear box has this; give mean_velocity, centre_velocity or "
           "pressure_gradient");
    if (domain.kind == DomainKind::vessel || domain.kind == DomainKind::periodic_box) {
      refuse(table, {&keys::mean_velocity, &keys::centre_velocity},
             "what force that takes is known for tube and plates only; give pressure_gradient");
    }
    read_pressure_driven(table, scene);
  }
  assess_openings(root, scene);
  scene.largest_velocity *= setup.waveform.largest();
  scene.largest_shear_rate *= setup.waveform.largest();
  require_low_mach(table, scene);
}

}  // namespace npfem::flow
