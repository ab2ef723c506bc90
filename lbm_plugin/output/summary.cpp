// SPDX-License-Identifier: MPL-2.0
#include "output/summary.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include <nlohmann/json.hpp>

#include "npfem/npfem.hpp"
#include "scene/make_cells.h"

namespace npfem::flow {

bool fluid_failed(const Simulation& simulation, Communicator& communicator) {
  return communicator.any(!simulation.lattice().is_finite());
}

namespace {

/// Of the cells that the run began with; leaves those that are still there in cells_by_type.
void count_departures(const std::vector<Departure>& departures, Summary& s) {
  s.cells_left = static_cast<int>(departures.size());
  s.cells_left_by_type.assign(s.cells_by_type.size(), 0);
  s.volume_left_by_type.assign(s.cells_by_type.size(), 0.0);
  for (const Departure& departure : departures) {
    const auto type = static_cast<std::size_t>(departure.type);
    --s.cells_by_type[type];
    ++s.cells_left_by_type[type];
    s.volume_left_by_type[type] += departure.volume;
  }
}

}  // namespace

Summary summarise(const Scene& scene, const Simulation& simulation, Communicator& communicator, double wall_s) {
  Summary s;
  s.title = scene.title;
  s.version = api::text_of([](char* buffer, std::int32_t capacity) { return npfem_version(buffer, capacity); });
  s.steps = simulation.steps_done();
  s.time_us = simulation.time_us();
  s.wall_s = wall_s;
  s.ranks = communicator.size();
  std::array<std::int64_t, 1> nodes{simulation.lattice().nodes().fluid_nodes()};
  communicator.sum(std::span<std::int64_t>(nodes));
  s.fluid_nodes = nodes[0];
  s.counters = simulation.counters();
  if (wall_s > 0) {
    s.mlups = static_cast<double>(s.fluid_nodes) * static_cast<double>(s.steps) / wall_s * 1e-6;
    s.cell_steps_per_s = static_cast<double>(s.counters.cell_steps) / wall_s;
  }
  s.cells = simulation.cell_count();
  s.cells_by_type.assign(scene.setup.types.size(), 0);
  for (const CellType& type : scene.setup.types) s.cell_types.push_back(type.name);
  for (const CellStart& cell : scene.setup.cells) ++s.cells_by_type[static_cast<std::size_t>(cell.type)];
  count_departures(simulation.departures(), s);
  s.haematocrit_by_type = haematocrit_by_type(scene.setup, s.cells_by_type);
  s.haematocrit = std::accumulate(s.haematocrit_by_type.begin(), s.haematocrit_by_type.end(), 0.0);
  s.momentum_error = simulation.momentum_error();
  s.volume_error = simulation.volume_error();
  s.minimum_gap_um = simulation.minimum_gap();
  s.crossings = simulation.crossings();
  s.worst_residual_pN = s.counters.worst_residual_pN;
  if (s.counters.cell_steps > 0) {
    s.iterations_per_cell_step =
        static_cast<double>(s.counters.iterations) / static_cast<double>(s.counters.cell_steps);
  }
  s.failures = simulation.failures();
  s.fluid_failed = fluid_failed(simulation, communicator);
  s.state_hash = simulation.state_hash();
  return s;
}

std::string to_json(const Summary& s) {
  std::array<char, 24> hash{};
  std::snprintf(hash.data(), hash.size(), "%016llx", static_cast<unsigned long long>(s.state_hash));
  nlohmann::ordered_json failures = nlohmann::ordered_json::array();
  for (const CellFailure& failure : s.failures) {
    failures.push_back({{"cell_id", failure.id},
                        {"type", s.cell_types[static_cast<std::size_t>(failure.type)]},
                        {"step", failure.step},
                        {"reason", failure.reason}});
  }
  nlohmann::ordered_json rheology = nlohmann::ordered_json::object();
  for (const auto& [name, value] : s.rheology) rheology[name] = value;
  const nlohmann::ordered_json json{
      {"title", s.title},
      {"version", s.version},
      {"interrupted", s.interrupted},
      {"resumed_from", s.resumed_from ? nlohmann::ordered_json(*s.resumed_from) : nlohmann::ordered_json()},
      {"fluid_failed", s.fluid_failed},
      {"steps", s.steps},
      {"time_us", s.time_us},
      {"wall_s", s.wall_s},
      {"mlups", s.mlups},
      {"cell_steps_per_s", s.cell_steps_per_s},
      {"ranks", s.ranks},
      {"fluid_nodes", s.fluid_nodes},
      {"cells", s.cells},
      {"cell_types", s.cell_types},
      {"cells_by_type", s.cells_by_type},
      {"haematocrit", s.haematocrit},
      {"haematocrit_by_type", s.haematocrit_by_type},
      {"cells_left", s.cells_left},
      {"cells_left_by_type", s.cells_left_by_type},
      {"volume_left_um3_by_type", s.volume_left_by_type},
      {"momentum_error", s.momentum_error},
      {"volume_error", s.volume_error},
      {"minimum_gap_um", s.minimum_gap_um},
      {"crossing_triangles", s.crossings},
      {"least_gap_um", s.counters.least_gap_um},
      {"worst_volume_error", s.counters.worst_volume_error},
      {"worst_residual_pN", s.worst_residual_pN},
      {"iterations_per_cell_step", s.iterations_per_cell_step},
      {"rheology", rheology},
      {"fluid_seconds", s.counters.fluid_seconds},
      {"cell_seconds", s.counters.cell_seconds},
      {"exchange_seconds", s.counters.exchange_seconds},
      {"failed_cells", s.failures.size()},
      {"failures", failures},
      {"state_hash", hash.data()},
  };
  return json.dump(2) + "\n";
}

}  // namespace npfem::flow
