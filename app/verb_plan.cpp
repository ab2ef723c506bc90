// SPDX-License-Identifier: MPL-2.0
// npfem plan: what a scene would compute, why, and what it would cost.
#include <cstdio>
#include <iostream>
#include <numeric>

#include <nlohmann/json.hpp>

#include "assessment.h"
#include "quantity.h"
#include "scene/make_cells.h"
#include "scene/memory_need.h"
#include "scene/scene.h"
#include "scene_options.h"
#include "session.h"
#include "units.h"

namespace npfem::app {
namespace {

using Json = nlohmann::ordered_json;

// Rough rates of one core (docs/benchmarks.md), for the estimate of cost only: updates of the fluid in double
// precision, and steps of vertices, with all that belongs to them: immersed boundary, contacts, cell solver.
constexpr double nodes_per_second = 45e6;
constexpr double vertex_steps_per_second = 1.0e6;
constexpr double gain_of_single_precision = 1.6;  // of the fluid

double fluid_rate(const flow::Setup& setup) {
  const bool single = setup.fluid_precision == flow::FluidPrecision::in_float;
  return single ? gain_of_single_precision * nodes_per_second : nodes_per_second;
}

const char* name_of(flow::DomainKind kind) {
  switch (kind) {
    case flow::DomainKind::tube:
      return "tube";
    case flow::DomainKind::shear_box:
      return "shear_box";
    case flow::DomainKind::plates:
      return "plates";
    case flow::DomainKind::vessel:
      return "vessel";
    case flow::DomainKind::periodic_box:
      break;
  }
  return "periodic_box";
}

const char* name_of(flow::CouplingScheme scheme) {
  switch (scheme) {
    case flow::CouplingScheme::peskin:
      return "peskin";
    case flow::CouplingScheme::lineage:
      return "lineage";
    case flow::CouplingScheme::implicit:
      break;
  }
  return "implicit";
}

std::vector<std::string> energies_of(const api::Model& model) {
  std::vector<std::string> names;
  const int count = api::check(npfem_model_energy_count(model.handle()));
  for (int i = 0; i < count; ++i) {
    names.push_back(api::text_of(
        [&](char* b, std::int32_t n) { return api::check(npfem_model_energy_name(model.handle(), i, b, n)); }));
  }
  return names;
}

Json describe_cells(const flow::Scene& scene, const std::vector<int>& counts) {
  const std::vector<double> shares = haematocrit_by_type(scene.setup, counts);
  Json list = Json::array();
  for (std::size_t type = 0; type < counts.size(); ++type) {
    const api::Model& model = *scene.setup.types[type].model;
    list.push_back({{"name", scene.setup.types[type].name},
                    {"cells", counts[type]},
                    {"haematocrit", shares[type]},
                    {"vertices", model.vertices()},
                    {"triangles", model.triangle_count()},
                    {"rest_area_um2", model.measure("rest_area")},
                    {"rest_volume_um3", model.measure("rest_volume")},
                    {"shear_modulus_uN_per_m", model.measure("shear_modulus")},
                    {"largest_modulus_uN_per_m", model.measure("largest_modulus")},
                    {"interior_viscosity_ratio", scene.setup.types[type].interior_viscosity_ratio},
                    {"energies", energies_of(model)}});
  }
  return list;
}

Json json_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json describe(const flow::Scene& scene) {
  const flow::Setup& setup = scene.setup;
  const std::vector<int> counts = cell_counts(scene);
  const flow::Units units{setup.domain.dx, setup.time_step, setup.density};
  const flow::FluidNodes fluid_nodes = flow::fluid_nodes(setup.domain);
  const flow::MemoryNeed memory = flow::memory_need(scene, fluid_nodes, counts);
  double vertices = 0;
  for (std::size_t type = 0; type < counts.size(); ++type) {
    vertices += static_cast<double>(counts[type]) * setup.types[type].model->vertices();
  }
  const auto& n = setup.domain.nodes;
  const bool several = std::accumulate(counts.begin(), counts.end(), 0) > 1;
  return {{"title", scene.title},
          {"domain",
           {{"kind", name_of(setup.domain.kind)},
            {"size_um", setup.domain.size()},
            {"dx_um", setup.domain.dx},
            {"nodes", n},
            {"fluid_nodes", fluid_nodes.count},
            {"fluid_nodes_counted", fluid_nodes.exact},
            {"fluid_volume_um3", setup.domain.fluid_volume()}}},
          {"fluid",
           {{"density_kg_per_m3", setup.density},
            {"kinematic_viscosity_um2_per_us", setup.kinematic_viscosity},
            {"time_step_us", setup.time_step},
            {"tau", units.relaxation_time(setup.kinematic_viscosity)}}},
          {"flow",
           {{"largest_velocity_um_per_us", json_or_null(scene.flow.velocity)},
            {"largest_shear_rate_per_us", json_or_null(scene.flow.shear_rate)},
            {"estimated", scene.flow.estimated},
            {"starts_developed", setup.start_developed}}},
          {"coupling",
           {{"active", vertices > 0},
            {"scheme", name_of(setup.coupling.scheme)},
            {"kernel_points", setup.coupling.kernel_points},
            {"fluid_steps_per_cell_step", setup.coupling.steps_per_solve}}},
          {"contact",
           {{"between_cells", several && setup.contact.cells.active()},
            {"with_walls", vertices > 0 && setup.domain.has_walls() && setup.contact.walls.active()}}},
          {"cells", describe_cells(scene, counts)},
          {"run", {{"steps", scene.steps}, {"time_us", static_cast<double>(scene.steps) * setup.time_step}}},
          {"memory_MB",
           {{"fluid", 1e-6 * memory.fluid},
            {"cells", 1e-6 * memory.cells},
            {"of_this_machine", 1e-6 * flow::machine_memory()}}},
          {"seconds_per_step_on_one_core",
           {{"fluid", static_cast<double>(fluid_nodes.count) / fluid_rate(setup)},
            {"cells", vertices / vertex_steps_per_second / setup.coupling.steps_per_solve}}},
          {"limits", limits_as_json(limits_of(scene))},
          {"warnings", scene.warnings}};
}

double number(const Json& json, const char* group, const char* key) {
  return json.at(group).at(key).get<double>();
}

void print_cells(const Json& plan) {
  for (const Json& type : plan.at("cells")) {
    std::printf("cells     %d x %s, haematocrit %.4f: %d vertices, %.1f um2, %.1f um3; energies",
                type.at("cells").get<int>(), type.at("name").get<std::string>().c_str(),
                type.at("haematocrit").get<double>(), type.at("vertices").get<int>(),
                type.at("rest_area_um2").get<double>(), type.at("rest_volume_um3").get<double>());
    for (const Json& energy : type.at("energies")) std::printf(" %s", energy.get<std::string>().c_str());
    const double ratio = type.at("interior_viscosity_ratio").get<double>();
    if (ratio != 1)
      std::printf("; viscosity inside %.4g times that outside, nodes inside found anew in every solve", ratio);
    std::printf("\n");
  }
}

void print_active(const Json& plan) {
  if (!plan.at("coupling").at("active").get<bool>()) {
    std::puts("coupling  none: there are no cells");
    return;
  }
  const auto scheme = plan.at("coupling").at("scheme").get<std::string>();
  const char* remark = scheme == "lineage" ? " (for comparison only: momentum is not kept)" : "";
  std::printf("coupling  %s%s, %d-point kernel, cells solved every %d fluid step(s)\n", scheme.c_str(), remark,
              plan.at("coupling").at("kernel_points").get<int>(),
              plan.at("coupling").at("fluid_steps_per_cell_step").get<int>());
  std::printf("contact   between cells: %s; with walls: %s\n",
              plan.at("contact").at("between_cells").get<bool>() ? "yes" : "no (one cell, or range 0)",
              plan.at("contact").at("with_walls").get<bool>() ? "yes" : "no (no walls, or range 0)");
}

void print_flow(const flow::FlowScale& flow) {
  const auto shown = [](const std::optional<double>& value, double factor, const char* unit) {
    return value ? text::format_rounded(factor * *value) + " " + unit : std::string("an unknown shear rate");
  };
  if (!flow.velocity) return (void)std::puts("flow      unknown: the walls leave no section along which it is known");
  std::printf("flow      up to %s and %s without cells%s\n", shown(flow.velocity, 1e3, "mm/s").c_str(),
              shown(flow.shear_rate, 1e6, "1/s").c_str(),
              flow.estimated ? ", an estimate by the narrowest section" : "");
}

void print(const Json& plan, const flow::Scene& scene) {
  const auto& n = scene.setup.domain.nodes;
  std::printf("%s\n", scene.title.c_str());
  std::printf("domain    %s, %d x %d x %d nodes of %.4g um, %s%.0f of them fluid\n",
              plan.at("domain").at("kind").get<std::string>().c_str(), n[0], n[1], n[2], scene.setup.domain.dx,
              plan.at("domain").at("fluid_nodes_counted").get<bool>() ? "" : "about ",
              number(plan, "domain", "fluid_nodes"));
  std::printf("fluid     tau %.4g, time step %.4g us, kinematic viscosity %.4g mm2/s\n", number(plan, "fluid", "tau"),
              scene.setup.time_step, scene.setup.kinematic_viscosity);
  print_flow(scene.flow);
  print_cells(plan);
  print_active(plan);
  const double seconds =
      number(plan, "seconds_per_step_on_one_core", "fluid") + number(plan, "seconds_per_step_on_one_core", "cells");
  std::printf("run       %lld steps, %.4g us\n", static_cast<long long>(scene.steps), number(plan, "run", "time_us"));
  const double need = number(plan, "memory_MB", "fluid") + number(plan, "memory_MB", "cells");
  const double memory = number(plan, "memory_MB", "of_this_machine");
  std::printf("memory    about %.0f MB fluid, %.1f MB cells; this machine has %.0f MB%s\n",
              number(plan, "memory_MB", "fluid"), number(plan, "memory_MB", "cells"), memory,
              need > memory ? ", too little for it" : "");
  std::printf("cost      about %.3g s per step on one core (fluid %.3g, cells %.3g), %.3g s in all\n", seconds,
              number(plan, "seconds_per_step_on_one_core", "fluid"),
              number(plan, "seconds_per_step_on_one_core", "cells"), seconds * static_cast<double>(scene.steps));
  std::puts("limits");
  print_limits(limits_of(scene));
  for (const std::string& warning : scene.warnings) std::printf("warning: %s\n", warning.c_str());
}

}  // namespace

Action add_plan(CLI::App& program) {
  const auto options = std::make_shared<SceneOptions>();
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand("plan", "say what a scene computes and what it costs");
  options->add_to(*command);
  command->add_flag("--json", *as_json, "print the plan as JSON");
  return [options, as_json](Session& session) {
    if (!session.first()) return static_cast<int>(done);
    flow::Scene scene = flow::read_scene(options->path, options->assignments);
    flow::make_types(scene);
    const Json plan = describe(scene);
    if (*as_json) std::cout << plan.dump(2) << "\n";
    if (!*as_json) print(plan, scene);
    return static_cast<int>(done);
  };
}

}  // namespace npfem::app
