// SPDX-License-Identifier: MPL-2.0
// Blood: time per fluid step of a whole suspension, where it goes, and how far the result is from that of a time step
// four times finer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "bench/blood.h"
#include "bench/clock.h"
#include "bench/suites.h"
#include "communicator/communicator.h"
#include "coupling/cell_population.h"
#include "lattice/threads.h"
#include "simulation/simulation.h"

namespace npfem::app::bench {
namespace {

constexpr double us_compared = 5;  // simulated, for the error

std::vector<std::string> in_precision(const std::string& precision) {
  return {"fluid.precision=\"" + precision + "\"", "solver.precision=\"" + precision + "\""};
}

/// Vertices of the own cells by global id.
std::vector<flow::CellState> advanced(const flow::Setup& setup, flow::Communicator& communicator, double us) {
  flow::Simulation simulation(setup, communicator);
  const auto steps = static_cast<int>(std::lround(us / setup.time_step));
  for (int step = 0; step < steps; ++step) simulation.step();
  return simulation.local_cells();
}

/// Root of the mean square distance of the vertices of two runs after `us`, over that of what the cells did by
/// themselves: their way from the start less the motion of the sheared fluid without them, which any time step gets
/// right. Cells that two ranks hold in the two runs are left out.
double distance_over_own_way(const flow::Setup& setup, const std::vector<flow::CellState>& cells,
                             const std::vector<flow::CellState>& finer, double us, flow::Communicator& communicator) {
  const flow::Domain& domain = setup.domain;
  const double height = domain.size()[1], strain = domain.plate_speed / height * us;
  std::array<double, 2> sums{};
  for (const flow::CellState& cell : cells) {
    const auto other = std::find_if(finer.begin(), finer.end(), [&](const auto& c) { return c.id == cell.id; });
    if (other == finer.end()) continue;
    const auto start = flow::start_positions(setup.cells[static_cast<std::size_t>(cell.id)],
                                             setup.types[static_cast<std::size_t>(cell.type)]);
    for (std::size_t i = 0; i < start.size(); ++i) {
      const bool along = i % 3 == domain.flow_axis();
      const double carried = along ? strain * (start[i - i % 3 + 1] - 0.5 * height) : 0.0;
      sums[0] += std::pow(cell.position[i] - other->position[i], 2);
      sums[1] += std::pow(other->position[i] - start[i] - carried, 2);
    }
  }
  communicator.sum(sums);
  return std::sqrt(sums[0] / sums[1]);
}

struct Timing {
  double ms_per_step;
  std::vector<std::pair<std::string, double>> phases_ms;
  double cell_steps_per_step;
  double iterations_per_cell_step;
  double momentum_error, volume_error;
  std::size_t failed;
};

/// Median of the slowest rank's time over blocks of steps that hold one step of the cells each.
Timing timed(const flow::Setup& setup, flow::Communicator& communicator, int blocks) {
  flow::Simulation simulation(setup, communicator);
  const int k = setup.coupling.steps_per_solve;
  const auto block = [&] {
    for (int step = 0; step < k; ++step) simulation.step();
  };
  for (int warm = 0; warm < 2; ++warm) block();
  const flow::Counters before = simulation.counters();
  const auto phases_before = simulation.phase_seconds();
  std::vector<double> times;
  for (int b = 0; b < blocks; ++b) {
    communicator.barrier();
    const Stopwatch watch(Clock::wall);
    block();
    double us = watch.us();
    communicator.maximum(std::span(&us, 1));
    times.push_back(us);
  }
  const flow::Counters after = simulation.counters();
  const auto phases_after = simulation.phase_seconds();
  std::nth_element(times.begin(), times.begin() + blocks / 2, times.end());
  Timing timing{};
  timing.ms_per_step = 1e-3 * times[static_cast<std::size_t>(blocks / 2)] / k;
  const double steps = static_cast<double>(blocks) * k;
  for (std::size_t p = 0; p < phases_after.size(); ++p) {
    timing.phases_ms.emplace_back(phases_after[p].first,
                                  1e3 * (phases_after[p].second - phases_before[p].second) / steps);
  }
  const auto cell_steps = static_cast<double>(after.cell_steps - before.cell_steps);
  timing.cell_steps_per_step = cell_steps / steps;
  timing.iterations_per_cell_step = static_cast<double>(after.iterations - before.iterations) / cell_steps;
  timing.momentum_error = simulation.momentum_error();
  timing.volume_error = simulation.volume_error();
  timing.failed = simulation.failures().size();
  return timing;
}

/// The same cells at the same places in another precision.
flow::Setup in_same_places(const std::string& name, const flow::Setup& in_double, const std::string& precision) {
  flow::Setup setup = in_double;
  if (precision == "double") return setup;
  const flow::Scene scene = blood_scene(name, in_precision(precision));
  setup.types = scene.setup.types;
  setup.fluid_precision = scene.setup.fluid_precision;
  return setup;
}

void use_threads(int threads, flow::Setup& setup) {
  flow::set_lattice_threads(threads);
  for (flow::CellType& type : setup.types) {
    std::erase_if(type.options, [](const auto& option) { return option.first == "threads"; });
    type.options.emplace_back("threads", threads);
  }
}

struct Case {
  std::string scene, precision;
  int threads, ranks;
};

Json row_of(const Case& of, const flow::Setup& setup, const Timing& t, double error) {
  const double nodes = std::accumulate(setup.domain.nodes.begin(), setup.domain.nodes.end(), 1.0,
                                       [](double product, int n) { return product * n; });
  Json phases;
  for (const auto& [phase, ms] : t.phases_ms) phases[phase] = ms;
  return {{"scene", of.scene},
          {"precision", of.precision},
          {"threads", of.threads},
          {"ranks", of.ranks},
          {"cells", setup.cells.size()},
          {"ms_per_step", t.ms_per_step},
          {"phases_ms", phases},
          {"mlups", 1e-3 * nodes / t.ms_per_step},
          {"cell_steps_per_s", 1e3 * t.cell_steps_per_step / t.ms_per_step},
          {"iterations_per_cell_step", t.iterations_per_cell_step},
          {"seconds_per_simulated_ms", t.ms_per_step / setup.time_step},
          {"error", error},
          {"momentum_error", t.momentum_error},
          {"volume_error", t.volume_error},
          {"failed_cells", t.failed}};
}

void print(const Case& of, const flow::Setup& setup, const Timing& t, double error) {
  std::printf("%s %s, %d threads, %d ranks: %.1f ms per step, %.0f cell-steps/s, %.2f s per simulated us\n ",
              of.scene.c_str(), of.precision.c_str(), of.threads, of.ranks, t.ms_per_step,
              1e3 * t.cell_steps_per_step / t.ms_per_step, 1e-3 * t.ms_per_step / setup.time_step);
  for (const auto& [phase, ms] : t.phases_ms) std::printf(" %s %.2f", phase.c_str(), ms);
  std::printf(" ms; error %.2g\n", error);
  std::fflush(stdout);
}

/// One scene in both precisions, with each number of threads.
void measure_scene(const std::string& name, const Plan& plan, flow::Communicator& communicator, Json& rows) {
  const bool first = communicator.rank() == 0;
  if (first) say("placing the cells of " + name);
  const flow::Scene in_double = blood_scene(name, in_precision("double"));
  flow::Setup finer = in_double.setup;
  finer.time_step /= 4;
  flow::set_lattice_threads(plan.threads.back());
  if (first) say("running " + name + " with a time step four times finer");
  const auto reference = advanced(finer, communicator, us_compared);
  for (const std::string& precision : {std::string("double"), std::string("float")}) {
    flow::Setup setup = in_same_places(name, in_double.setup, precision);
    const auto cells = advanced(setup, communicator, us_compared);
    const double error = distance_over_own_way(setup, cells, reference, us_compared, communicator);
    for (const int threads : plan.threads) {
      use_threads(threads, setup);
      const Timing t = timed(setup, communicator, plan.quick ? 3 : 20);
      const Case of{name, precision, threads, communicator.size()};
      rows.push_back(row_of(of, setup, t, error));
      if (first) print(of, setup, t, error);
    }
  }
}

}  // namespace

Json measure_coupled(const Plan& plan, flow::Communicator& communicator) {
  const std::vector<std::string> names =
      plan.quick ? std::vector<std::string>{"shear20_ht20"} : std::vector<std::string>{"shear50_ht35", "shear25_ht35"};
  Json rows = Json::array();
  for (const std::string& name : names) measure_scene(name, plan, communicator, rows);
  return rows;
}

}  // namespace npfem::app::bench
