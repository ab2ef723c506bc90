// SPDX-License-Identifier: MPL-2.0
#include "assessment.h"

#include <cstdio>

#include <nlohmann/json.hpp>

#include "communicator/serial_communicator.h"
#include "contact/surface_crossing.h"
#include "coupling/cell_population.h"

namespace npfem::app {

std::vector<flow::Limit> limits_of(const flow::Scene& scene) {
  return accuracy_limits(scene.setup, scene.flow.velocity, scene.flow.shear_rate);
}

namespace {

/// Says how many triangles pass through each other where cells start with given vertices, which nobody has kept apart;
/// empty where there are none.
std::string warning_of_crossings(const flow::Scene& scene) {
  const flow::Setup& setup = scene.setup;
  std::vector<flow::CellSurface> surfaces;
  bool given = false;
  for (std::size_t id = 0; id < setup.cells.size(); ++id) {
    const flow::CellStart& cell = setup.cells[id];
    given = given || !cell.positions.empty();
    const flow::CellType& type = setup.types[static_cast<std::size_t>(cell.type)];
    surfaces.push_back({static_cast<int>(id), cell.type, flow::start_positions(cell, type)});
  }
  flow::SerialCommunicator alone;
  const std::int64_t crossings = given ? flow::count_crossings(setup.domain, setup.types, alone, surfaces) : 0;
  if (crossings == 0) return "";
  return "cells start through each other: " + std::to_string(crossings) +
         " pairs of triangles cross; npfem pack makes a start without";
}

}  // namespace

std::vector<std::string> warnings_of(const flow::Scene& scene) {
  std::vector<std::string> warnings = scene.warnings;
  const std::string crossings = warning_of_crossings(scene);
  if (!crossings.empty()) warnings.push_back(crossings);
  return warnings;
}

void print_limits(const std::vector<flow::Limit>& limits) {
  for (const flow::Limit& limit : limits) {
    char value[32] = "-";
    if (limit.verdict != flow::Verdict::unknown) std::snprintf(value, sizeof value, "%.3g", limit.value);
    std::printf("  %-24s %-10s %-9s up to %.3g (good), %.3g (fair): %s\n", limit.name.c_str(), value,
                verdict_name(limit.verdict).c_str(), limit.strict_bound, limit.bound, limit.advice.c_str());
  }
}

nlohmann::ordered_json limits_as_json(const std::vector<flow::Limit>& limits) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const flow::Limit& limit : limits) {
    list.push_back({{"name", limit.name},
                    {"meaning", limit.meaning},
                    {"value", limit.value},
                    {"good_up_to", limit.strict_bound},
                    {"fair_up_to", limit.bound},
                    {"verdict", verdict_name(limit.verdict)},
                    {"advice", limit.advice}});
  }
  return list;
}

}  // namespace npfem::app
