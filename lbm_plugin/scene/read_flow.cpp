// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "geometry/channel_flow.h"
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

/// Of a tube or plates and nothing else.
SteadyFlow poiseuille(const Domain& domain, double dynamic_viscosity) {
  if (domain.kind == DomainKind::tube) {
    const double r = domain.tube_radius;
    return {r * r / (4 * dynamic_viscosity), 0.5, r / (2 * dynamic_viscosity)};
  }
  const double h = domain.size()[1];
  return {h * h / (8 * dynamic_viscosity), 2.0 / 3.0, h / (2 * dynamic_viscosity)};
}

double dynamic_viscosity(const Setup& setup) {
  return setup.density * setup.kinematic_viscosity;
}

FlowScale scale_at(const ChannelFlow& flow, double rate) {
  return {rate * flow.fastest, rate * flow.steepest, true};
}

/// The force is that of the channel without its solids, as Palabos-npFEM has it: what the solids leave of the flow is
/// known roughly only.
void warn_of_solids(const Table& table, const Key& drive, const std::optional<ChannelFlow>& flow, double gradient,
                    Scene& scene) {
  const Domain& domain = scene.setup.domain;
  std::string warning = "the force, " + format_quantity(rounded(gradient), "MPa/m") +
                        ", is that of the channel without the solids in it; ";
  if (flow) {
    const double rate = flow->rate_under(gradient * domain.size()[domain.flow_axis()], dynamic_viscosity(scene.setup));
    warning += "with them expect a mean velocity of roughly " +
               format_quantity(rounded(rate / flow->widest_area), "mm/s") + " in its widest section";
  } else {
    warning += "with them nothing flows, since they close it";
  }
  scene.warnings.push_back(table.located(drive.name, warning + "; give pressure_gradient to set the force itself"));
}

void read_pressure_driven(const Table& table, Scene& scene) {
  Setup& setup = scene.setup;
  const Domain& domain = setup.domain;
  const text::Key* drive = one_of(table, {&keys::mean_velocity, &keys::centre_velocity, &keys::pressure_gradient});
  if (!drive) return;
  const SteadyFlow plain = poiseuille(domain, dynamic_viscosity(setup));
  double gradient = table.quantity(*drive);
  if (drive == &keys::mean_velocity) gradient /= plain.mean_share * plain.centre_per_gradient;
  if (drive == &keys::centre_velocity) gradient /= plain.centre_per_gradient;
  setup.body_force[domain.flow_axis()] = gradient;
  if (domain.is_plain_channel()) {
    scene.flow = {gradient * plain.centre_per_gradient, gradient * plain.wall_rate_per_gradient};
    return;
  }
  const std::optional<ChannelFlow> flow = channel_flow(domain, domain.flow_axis());
  scene.flow = {std::nullopt, std::nullopt};
  if (flow) {
    const double drop = gradient * domain.size()[domain.flow_axis()];
    scene.flow = scale_at(*flow, flow->rate_under(drop, dynamic_viscosity(setup)));
  }
  if (drive != &keys::pressure_gradient && gradient > 0) warn_of_solids(table, *drive, flow, gradient, scene);
}

/// The lattice fluid is compressible: its speed of sound is dx/(sqrt 3 dt). `velocity` (um/us) is known to be reached.
void require_low_mach(const Table& table, const Scene& scene, double velocity) {
  constexpr double largest_mach = 0.3;
  const double sound = scene.setup.domain.dx / scene.setup.time_step / std::numbers::sqrt3;
  const double mach = velocity / sound;
  if (mach <= largest_mach) return;
  table.fail("the largest velocity, " + format_quantity(rounded(velocity), "mm/s") + ", is Mach " +
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
  if (setup.collision == Collision::trt) setup.magic_parameter = table.quantity(keys::magic_parameter);
  if (setup.collision != Collision::trt) {
    refuse(table, {&keys::magic_parameter},
           "is for collision \"trt\" only, this is \"" + collision + "\"; leave it out");
  }
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

/// Requires the pressure of an opening to be small for the lattice.
void require_low_pressure(const Table& table, const Opening& opening, const Setup& setup) {
  constexpr double largest_deviation = 0.1;  // of the density
  const double unit = Units{setup.domain.dx, setup.time_step, setup.density}.pressure();
  const double deviation = 3 * std::abs(opening.pressure) / unit * setup.waveform.largest();
  if (deviation <= largest_deviation) return;
  table.fail("pressure",
             format_quantity(opening.pressure, "Pa") + " changes the density of the lattice fluid by " +
                 text::format_rounded(100 * deviation) + " %, above 10 %: take a time step below " +
                 format_quantity(rounded(setup.time_step * std::sqrt(largest_deviation / deviation)), "us"));
}

/// Checks the openings; the largest velocity (um/us) that they prescribe.
double check_openings(const Table& root, const Setup& setup) {
  const std::vector<Table> tables = root.tables("openings");
  double fastest = 0;
  for (std::size_t n = 0; n < tables.size(); ++n) {
    const Opening& opening = setup.domain.openings[n];
    const std::vector<double> shares = inlet_profile(setup.domain, opening);
    const double largest = *std::max_element(shares.begin(), shares.end());
    if (largest == 0) tables[n].fail("face", "the walls leave nothing of this face open");
    if (opening.kind == Opening::Kind::velocity) fastest = std::max(fastest, std::abs(opening.mean_velocity) * largest);
    if (opening.kind == Opening::Kind::pressure) require_low_pressure(tables[n], opening, setup);
  }
  return fastest;
}

/// um3/us, where it is prescribed; two velocity openings may feed each other, so the larger of inflow and outflow.
double prescribed_rate(const Domain& domain) {
  double in = 0, out = 0;
  for (const Opening& opening : domain.openings) {
    if (opening.kind != Opening::Kind::velocity) continue;
    const std::vector<double> shares = inlet_profile(domain, opening);
    const auto open = std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0; });
    const double rate = opening.mean_velocity * static_cast<double>(open) * domain.dx * domain.dx;
    (rate > 0 ? in : out) += std::abs(rate);
  }
  return std::max(in, out);
}

/// Along one axis only can it be said what comes of the openings: the same flow passes every section.
FlowScale flow_between_openings(const Setup& setup) {
  const Domain& domain = setup.domain;
  const std::size_t axis = axis_of(domain.openings.front().face);
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  bool by_velocity = false;
  for (const Opening& opening : domain.openings) {
    if (axis_of(opening.face) != axis) return {std::nullopt, std::nullopt};
    by_velocity = by_velocity || opening.kind == Opening::Kind::velocity;
    if (opening.kind == Opening::Kind::velocity) continue;
    highest = std::max(highest, opening.pressure);
    lowest = std::min(lowest, opening.pressure);
  }
  const std::optional<ChannelFlow> flow = channel_flow(domain, axis);
  if (!flow) return {std::nullopt, std::nullopt};
  if (by_velocity) return scale_at(*flow, prescribed_rate(domain));
  return scale_at(*flow, flow->rate_under(highest - lowest, dynamic_viscosity(setup)));
}

/// The flow to start from is known where nothing but plates or a tube bounds it.
void require_known_flow(const Table& table, const Domain& domain) {
  if (domain.openings.empty() && domain.solids.empty()) return;
  table.fail("start", "a developed flow is known only without openings and solids; take \"rest\"");
}

void read_driving(const Table& table, Scene& scene) {
  Domain& domain = scene.setup.domain;
  if (domain.kind == DomainKind::shear_box) {
    require_not_driven(table,
                       "a shear box is driven by \"shear_rate\"; for a pressure-driven flow take the kind plates");
    const double rate = table.quantity(keys::shear_rate);
    domain.plate_speed = rate * domain.size()[1];
    scene.flow = {0.5 * domain.plate_speed, rate};
    if (!domain.solids.empty()) scene.flow.shear_rate.reset();  // no rate between a solid and a plate is known
  } else if (!domain.openings.empty()) {
    refuse(table, {&keys::shear_rate}, "only a shear box has this");
    require_not_driven(table, "the openings drive the flow; take this out or them");
    scene.flow = flow_between_openings(scene.setup);
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
}

}  // namespace

void read_flow(const text::Table& root, Scene& scene) {
  const Table table = root.table("flow");
  Setup& setup = scene.setup;
  if (table.has("waveform")) setup.waveform = read_waveform(table.table("waveform"));
  setup.start_developed = table.choice(keys::start) == "developed";
  if (setup.start_developed) require_known_flow(table, setup.domain);
  const double at_openings = check_openings(root, setup);
  read_driving(table, scene);
  FlowScale& flow = scene.flow;
  const double peak = setup.waveform.largest();
  if (flow.velocity) *flow.velocity *= peak;
  if (flow.shear_rate) *flow.shear_rate *= peak;
  require_low_mach(table, scene, flow.velocity && !flow.estimated ? *flow.velocity : peak * at_openings);
}

}  // namespace npfem::flow
