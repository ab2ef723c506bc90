// SPDX-License-Identifier: MPL-2.0
#include "coupling/limits.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "coupling/ambient_mass.h"
#include "coupling/interior.h"
#include "units.h"

namespace npfem::flow {
namespace {

struct Advice {
  const char* good;
  const char* fair;
  const char* exceeded;
};

Limit judged(std::string name, std::string meaning, double value, double strict_bound, double bound,
             const Advice& advice) {
  const Verdict verdict = value <= strict_bound ? Verdict::good : value <= bound ? Verdict::fair : Verdict::exceeded;
  const char* text = verdict == Verdict::good ? advice.good : verdict == Verdict::fair ? advice.fair : advice.exceeded;
  return {std::move(name), std::move(meaning), value, strict_bound, bound, verdict, text};
}

/// The same for a value that may be unknown: then there is no verdict on it.
Limit judged_if_known(std::string name, std::string meaning, std::optional<double> value, double strict_bound,
                      double bound, const Advice& advice) {
  if (value) return judged(std::move(name), std::move(meaning), *value, strict_bound, bound, advice);
  return {std::move(name),
          std::move(meaning),
          std::numeric_limits<double>::quiet_NaN(),
          strict_bound,
          bound,
          Verdict::unknown,
          "the flow of this scene is not known beforehand; look at the velocities it writes"};
}

void add_flow_limits(std::vector<Limit>& limits, const Units& units, double tau, std::optional<double> speed,
                     std::optional<double> shear_rate) {
  const double sound = units.velocity() / std::sqrt(3.0);
  if (speed) *speed /= sound;
  if (shear_rate) *shear_rate *= (tau - 0.5) * units.dt;
  limits.push_back(judged_if_known(
      "Ma", "fastest imposed flow over the lattice's speed of sound; the lattice fluid is compressible", speed, 0.1,
      0.3,
      {"the fluid is as good as incompressible", "density varies by a few percent; a smaller time step helps",
       "the flow is too fast for this time step; reduce time_step"}));
  limits.push_back(judged_if_known("gdot_T", "shear rate times T = (tau - 1/2) dt, the memory of the lattice fluid",
                                   shear_rate, 0.02, 0.02,
                                   {"the fluid follows at once", "", "the fluid lags behind; reduce time_step"}));
}

void add_fluid_limits(std::vector<Limit>& limits, double tau, double ratio) {
  limits.push_back(judged("tau", "relaxation time of the lattice fluid, in time steps; above 1/2", tau, 12.0, 12.0,
                          {"steady flow is exact between walls; for flow that changes in time, see gdot T", "",
                           "larger than any that has been tried; reduce time_step"}));
  if (ratio != 1) {
    limits.push_back(judged(
        "tau_inside", "the same inside the cells, whose fluid has a viscosity of its own", 0.5 + ratio * (tau - 0.5),
        12.0, 12.0,
        {"the fluid inside is as good as that outside", "", "larger than any that has been tried; reduce time_step"}));
  }
}

void add_contact_limit(std::vector<Limit>& limits, const Setup& setup, std::optional<double> shear_rate) {
  const ContactLaw& law = setup.contact.cells;
  if (!law.active() || law.strength == 0) return;
  if (shear_rate) *shear_rate *= setup.density * setup.kinematic_viscosity / law.strength;
  limits.push_back(judged_if_known(
      "contact", "viscous stress of the imposed flow over the pressure between two cells at touch (contact.strength)",
      shear_rate, 0.04, 0.1,
      {"contacts keep cells apart", "cells may overlap by a fraction of the range for moments; a larger strength helps",
       "the flow presses cells into each other; raise contact.strength"}));
}

void add_cell_limits(std::vector<Limit>& limits, const Setup& setup, const Units& units, const CellType& type) {
  const double delta = setup.coupling.steps_per_solve * setup.time_step;
  const double layer = ambient_layer(setup.coupling.kernel_points, units, setup.kinematic_viscosity, delta);
  const double radius = std::sqrt(type.model->measure("rest_area") / (4.0 * std::numbers::pi));
  const double shear = type.model->measure("shear_modulus");
  const double largest = type.model->measure("largest_modulus");
  if (setup.coupling.scheme == CouplingScheme::implicit) {
    const double per_modulus = delta * delta / (setup.density * layer * radius * radius);
    const Advice advice{"the fluid feels the membrane as stiff as it is",
                        "volume and deformation are off by about this much; for less, reduce time_step or cell_every",
                        "the fluid feels too soft a membrane; reduce time_step or cell_every"};
    limits.push_back(judged("kappa_shear " + type.name,
                            "compliance of the coupling against shear: delta^2 G/(rho ell a^2)", per_modulus * shear,
                            0.002, 0.005, advice));
    limits.push_back(
        judged("kappa_largest " + type.name, "the same with the largest modulus, which keeps area and volume",
               per_modulus * largest, 0.002, 0.005,
               {advice.good, advice.fair,
                "vertices keep the stiff constraint exactly, but the fluid resists it less than it should; "
                "reduce time_step or cell_every if the cell is driven against it"}));
  }
  // On a surface of equilateral triangles a vertex has the area (sqrt 3/2) spacing^2.
  const double area = type.model->measure("rest_area") / static_cast<double>(type.shape.size() / 3);
  const double reach = 0.5 * setup.coupling.kernel_points * units.dx;
  limits.push_back(judged("spacing " + type.name, "distance of neighbouring vertices over the reach of the kernel",
                          std::sqrt(area * 2 / std::sqrt(3.0)) / reach, 0.85, 1.1,
                          {"the surface is tight", "the surface leaks a little: a percent or two in the flow past it",
                           "fluid leaks between the vertices; take a wider kernel, a larger level or a larger dx"}));
  limits.push_back(judged(
      "compression " + type.name, "3 G_s/a in lattice units: how much a cell's own tension compresses the fluid in it",
      3.0 * shear / (units.pressure() * radius), 0.008, 0.02,
      {"the cell keeps its volume", "the cell shrinks by about this much; for less, reduce time_step",
       "the cell shrinks too much; reduce time_step"}));
}

}  // namespace

std::vector<Limit> accuracy_limits(const Setup& setup, std::optional<double> speed, std::optional<double> shear_rate) {
  const Units units{setup.domain.dx, setup.time_step, setup.density};
  std::vector<Limit> limits;
  const double tau = units.relaxation_time(setup.kinematic_viscosity);
  add_fluid_limits(limits, tau, interior_viscosity_ratio(setup));
  add_flow_limits(limits, units, tau, speed, shear_rate);
  if (!setup.types.empty()) add_contact_limit(limits, setup, shear_rate);
  for (const CellType& type : setup.types) add_cell_limits(limits, setup, units, type);
  return limits;
}

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::good:
      return "good";
    case Verdict::fair:
      return "fair";
    case Verdict::exceeded:
      return "exceeded";
    case Verdict::unknown:
      break;
  }
  return "unknown";
}

}  // namespace npfem::flow
