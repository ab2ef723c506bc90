// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_parameters.h"

#include <array>
#include <cmath>

#include "nearest.h"

namespace npfem::flow {
namespace {

using P = LineageParameters;

P::Flow read_flow_kind(const LineageXml& xml) {
  const std::string& word = xml.text("Simulation_Type");
  if (word == "Shear_Flow") return P::Flow::shear;
  if (word == "Poiseuille_Flow") return P::Flow::tube;
  if (word == "Box_Poiseuille_Flow") return P::Flow::plates;
  xml.fail("Simulation_Type", "unknown word \"" + word + "\"" +
                                  text::suggestion(word, {"Shear_Flow", "Poiseuille_Flow", "Box_Poiseuille_Flow"}));
}

LineageBodyParameters read_body(const LineageXml& xml, const std::string& kind, double fluid_density) {
  const std::string section = "ShapeOp_" + kind + "/";
  LineageBodyParameters body;
  body.case_study = xml.text("Case_Study_" + kind);
  body.density = xml.positive(section + "rho");
  if (body.density < fluid_density) {
    xml.fail(section + "rho", xml.text(section + "rho") + " is less than the density of the fluid, " +
                                  xml.text("Physical_Properties/rho_p") +
                                  ": a cell lighter than the fluid it holds is not allowed");
  }
  body.alpha = xml.number(section + "Calpha");
  if (body.alpha < 0 || body.alpha > 1) xml.fail(section + "Calpha", "must lie between 0 and 1");
  body.beta = xml.number(section + "Cbeta");
  if (body.beta < 0) xml.fail(section + "Cbeta", "must not be negative");
  if (!xml.boolean(section + "applyGlobalVolumeConservation")) {
    xml.fail(section + "applyGlobalVolumeConservation",
             "must be true: without it the lineage gives a surface no volume and no mass");
  }
  body.volume_weight = xml.number(section + "globalVolumeConservationWeight");
  if (body.volume_weight < 0) xml.fail(section + "globalVolumeConservationWeight", "must not be negative");
  return body;
}

/// Exactly one of tau, time step and lattice velocity is given, the others are negative.
void read_clock(const LineageXml& xml, P& p) {
  const std::string tau = "System_Setup/tau_lb", dt = "System_Setup/dt_p", velocity = "System_Setup/u_lb";
  int given = 0;
  for (const std::string& key : {tau, dt, velocity}) given += xml.number(key) > 0 ? 1 : 0;
  if (given != 1) {
    xml.fail(tau, "exactly one of tau_lb, dt_p and u_lb must be positive, the others negative; found " + xml.text(tau) +
                      ", " + xml.text(dt) + " and " + xml.text(velocity));
  }
  if (xml.number(tau) > 0) {
    p.tau = xml.number(tau);
    if (p.tau <= 0.5) xml.fail(tau, xml.text(tau) + " must be greater than 0.5");
  }
  if (xml.number(dt) > 0) p.time_step = xml.number(dt);
  if (xml.number(velocity) > 0) {
    const double fastest = p.flow == P::Flow::shear ? p.shear_rate * p.size[1] : p.centre_velocity;
    if (!(fastest > 0)) xml.fail(velocity, "gives the time step only where the flow has a velocity (u_p, shear_rate)");
    p.time_step = p.dx * xml.number(velocity) / fastest;
  }
}

double fraction(const LineageXml& xml, const std::string& key) {
  const double value = xml.number(key);
  if (value < 0 || value > 1) xml.fail(key, xml.text(key) + " must lie between 0 and 1");
  return value;
}

/// As the lineage does, to the nearest whole number of spacings.
void read_size(const LineageXml& xml, P& p) {
  const std::array<std::string, 3> keys{"System_Setup/lx_p", "System_Setup/ly_p", "System_Setup/lz_p"};
  p.size_is_rounded = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double exact = xml.positive(keys[axis]);
    const double whole = whole_spacings(exact, p.dx);
    const bool is_whole = std::abs(whole - exact) <= 1e-6 * p.dx;
    p.size[axis] = is_whole ? exact : whole;
    p.size_is_rounded = p.size_is_rounded || !is_whole;
  }
}

/// What drives the flow; that of another kind of flow does not count and may be anything.
double driving(const LineageXml& xml, const std::string& key, bool counts) {
  const double value = xml.number(key);
  if (counts && value < 0) {
    xml.fail(key, xml.text(key) + " must not be negative; turn the scene round where the flow is to go the other way");
  }
  return value;
}

void read_system(const LineageXml& xml, P& p) {
  const std::string s = "System_Setup/";
  p.output_folder = xml.text(s + "OutputDir");
  p.position_file = xml.text(s + "pos_filename");
  p.wall_file = xml.text(s + "wallStlFileName");
  p.with_bodies = xml.boolean(s + "withBodies");
  p.haematocrit = xml.number(s + "ht") / 100;
  if (p.haematocrit < 0 || p.haematocrit >= 1) xml.fail(s + "ht", "must lie between 0 and 100");
  p.rbc_per_platelet = xml.number(s + "RBCsToPLT");
  p.dx = xml.positive(s + "dx_p");
  read_size(xml, p);
  p.centre_velocity = driving(xml, s + "u_p", p.flow != P::Flow::shear);
  p.shear_rate = driving(xml, s + "shear_rate", p.flow == P::Flow::shear) / 1e6;
  p.output_every = xml.whole_number(s + "output_timestep", 1);
  p.duration = xml.positive(s + "max_time") * 1e6;
  p.write_cells = xml.boolean(s + "printVTKs");
  double centres = 0;
  p.all_cells_written = true;
  for (const char* kind : {"RBCs", "PLTs"}) {
    const double shown = fraction(xml, s + "dump_" + kind + "_ratio_VTKs");
    const double logged = fraction(xml, s + "dump_" + kind + "_ratio_COMs");
    p.all_cells_written = p.all_cells_written && shown == std::floor(shown) && logged == std::floor(logged);
    centres += logged;
  }
  p.write_centres = centres > 0;
}

void read_solver(const LineageXml& xml, P& p) {
  const std::string s = "ShapeOp_General/";
  p.solve_every = xml.whole_number(s + "timestep", 1);
  p.solver = {.history = xml.whole_number(s + "m", 2) - 2,
              .max_iterations = xml.whole_number(s + "max_iterations", 1),
              .max_line_search = xml.whole_number(s + "max_line_search_loops", 1),
              .attempts = xml.whole_number(s + "max_attempts_to_solve_stagnation", 1),
              .window = xml.whole_number(s + "convergence_window", 2),
              .tolerance = xml.positive(s + "tol"),
              .armijo = xml.positive(s + "gamma"),
              .curvature = xml.positive(s + "gamma2")};
  p.forcing_iterations = xml.whole_number("System_Setup/inamuro_iT", 1);
  const auto contact = [&](const std::string& kind) {
    const double range = xml.number(s + "collisions_threshold_" + kind) * p.dx;  // lattice units
    const double weight = xml.number(s + "collisions_weight_" + kind);
    if (range < 0) xml.fail(s + "collisions_threshold_" + kind, "must not be negative");
    if (weight < 0) xml.fail(s + "collisions_weight_" + kind, "must not be negative");
    return P::Contact{range, weight};
  };
  p.like = contact("nonRep");
  p.unlike = contact("rep");
}

}  // namespace

double whole_spacings(double length, double dx) {
  constexpr double digits = 1e9;
  return std::round(std::round(length / dx) * dx * digits) / digits;
}

LineageParameters read_lineage_parameters(const LineageXml& xml) {
  LineageParameters p{};
  p.flow = read_flow_kind(xml);
  read_system(xml, p);
  p.viscosity = xml.positive("Physical_Properties/nu_p");
  p.density = xml.positive("Physical_Properties/rho_p");
  p.packing = xml.boolean("CellPacking/Run");
  read_clock(xml, p);
  p.restart = xml.boolean("CheckPointing/restartFromCP");
  p.checkpoint_folder = xml.text("CheckPointing/CP_OutputDir");
  p.checkpoint_every = xml.whole_number("CheckPointing/checkpoint_timestep", 1);
  p.rbc_count = xml.whole_number("CheckPointing/numRBC", 0);
  p.platelet_count = xml.whole_number("CheckPointing/numPLT", 0);
  p.rbc = read_body(xml, "RBC", p.density);
  p.platelet = read_body(xml, "PLT", p.density);
  read_solver(xml, p);
  return p;
}

}  // namespace npfem::flow
