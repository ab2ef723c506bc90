// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bench/cells.h"
#include "bench/loads.h"
#include "bench/suites.h"

namespace npfem::app::bench {
namespace {

constexpr int timed_cells = 16;        ///< fills the SIMD lanes in any precision
constexpr double sample_every = 20;    ///< us; a multiple of every time step
constexpr double switching_time = 80;  ///< us
constexpr int reference_refinement = 16;

struct Scenario {
  const char* name;
  std::vector<double> (*loads)(std::span<const double>, std::span<const double>, double);
  double force;              ///< pN
  double (*course)(double);  ///< share of the force over the time in us
};

/// A force pair switched on smoothly, which then stays.
double switched_on(double t) {
  const double s = std::min(t / switching_time, 1.0);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}
/// A pulse that rises and falls smoothly.
double pulse(double t) {
  const double s = std::sin(std::numbers::pi * std::min(t / switching_time, 1.0));
  return s * s * s * s;
}

const Scenario scenarios[] = {{"stretch", stretching_loads, 15, switched_on}, {"shear", shearing_loads, 60, pulse}};

/// A cell at its equilibrium without loads.
struct RestingCell {
  api::Model model;
  std::vector<double> position, area;
};

RestingCell resting_cell(int vertices) {
  RestingCell cell{red_cell("rbc", vertices), {}, {}};
  api::Batch batch(cell.model, "cpu", 1);
  batch.set("tolerance", 1e-5);
  batch.relax();
  cell.position.resize(3 * static_cast<std::size_t>(vertices));
  batch.read("position", 0, 1, cell.position);
  cell.area = cell.model.get("rest_area");
  return cell;
}

struct Motion {
  std::vector<std::vector<double>> samples;  ///< positions of the first cell every `sample_every`
  double us_per_simulated_us = 0;            ///< of one cell
  double iterations = 0;                     ///< per step
  std::vector<double> extents;               ///< along x at the samples, um
  int failed_cells = 0;
};

/// Runs `duration` us. Loads are those at the end of each step, where an implicit step needs them. Only the steps
/// themselves are timed.
Motion run(const RestingCell& cell, const Scenario& scenario, const Setting& setting, int cells, double duration) {
  const std::vector<double> at_rest(cell.position.size(), 0.0);
  const std::vector<double> full = scenario.loads(cell.position, cell.area, scenario.force);
  const Start start = copies_of(cell.position, at_rest, cells);
  api::Batch batch = make_batch(cell.model, setting, cells);
  restore(batch, start);
  batch.step();  // makes the factors
  restore(batch, start);

  Motion motion;
  const auto steps = std::lround(duration / setting.time_step),
             per_sample = std::lround(sample_every / setting.time_step);
  std::vector<double> loads(full.size() * static_cast<std::size_t>(cells)), position(cell.position.size());
  double us = 0;
  for (long s = 1; s <= steps; ++s) {
    stop_if_interrupted();
    const double share = scenario.course(static_cast<double>(s) * setting.time_step);
    for (std::size_t i = 0; i < loads.size(); ++i) loads[i] = share * full[i % full.size()];
    batch.write("external_force", 0, cells, loads);
    const Stopwatch watch(Clock::cpu);
    motion.failed_cells = std::max(motion.failed_cells, batch.step());
    us += watch.us();
    motion.iterations += batch.iterations()[0];
    if (s % per_sample != 0) continue;
    batch.read("position", 0, 1, position);
    motion.samples.push_back(position);
    motion.extents.push_back(batch.measure("extent_x")[0]);
  }
  motion.us_per_simulated_us = us / (duration * cells);
  motion.iterations /= static_cast<double>(steps);
  return motion;
}

/// Largest distance at any sample, over the largest displacement of the reference.
double relative_error(const Motion& motion, const Motion& reference, const std::vector<double>& from) {
  double error = 0, moved = 0;
  for (std::size_t k = 0; k < reference.samples.size(); ++k) {
    error = std::max(error, largest_distance(motion.samples[k], reference.samples[k]));
    moved = std::max(moved, largest_distance(reference.samples[k], from));
  }
  return error / moved;
}

Json row_of(const Scenario& scenario, const char* study, int vertices, const Setting& setting, const Motion& motion,
            double error) {
  return {{"scenario", scenario.name},
          {"study", study},
          {"mesh", vertices},
          {"integrator", setting.integrator == 1 ? "bdf2" : "euler"},
          {"time_step_us", setting.time_step},
          {"tolerance_pN", setting.tolerance},
          {"precision", precision_names[static_cast<std::size_t>(setting.precision)]},
          {"us_per_simulated_us", motion.us_per_simulated_us},
          {"iterations", motion.iterations},
          {"failed_cells", motion.failed_cells},
          {"relative_error", error}};
}

void report(const Json& row) {
  char line[160];
  std::snprintf(line, sizeof line, "%-8s %5d  %-5s  step %5.2f us  tol. %6g pN  %-6s %9.3f us/us  error %.2e",
                row["scenario"].get<std::string>().c_str(), row["mesh"].get<int>(),
                row["integrator"].get<std::string>().c_str(), row["time_step_us"].get<double>(),
                row["tolerance_pN"].get<double>(), row["precision"].get<std::string>().c_str(),
                row["us_per_simulated_us"].get<double>(), row["relative_error"].get<double>());
  say(line);
}

/// Everything but the mesh, against a solution with steps 16 times finer.
void add_time_study(const Plan& plan, const RestingCell& cell, const Scenario& scenario, Json& results) {
  const double duration = plan.quick ? 40 : 160;
  const std::vector<double> time_steps =
      plan.quick ? std::vector<double>{5, 10} : std::vector<double>{0.25, 0.5, 1, 2, 5, 10, 20};
  Setting setting;
  setting.integrator = 1, setting.tolerance = 1e-9;
  setting.time_step = time_steps[0] / reference_refinement;
  setting.lone_cells = true;
  say(std::string("reference solution: ") + scenario.name);
  const Motion reference = run(cell, scenario, setting, 1, duration);
  setting.lone_cells = false;
  for (const int integrator : {0, 1}) {
    for (const int precision : plan.precisions) {
      for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
        if (plan.quick && tolerance < 1e-2) continue;
        for (const double time_step : time_steps) {
          setting.integrator = integrator, setting.precision = precision;
          setting.tolerance = tolerance, setting.time_step = time_step;
          const Motion motion = run(cell, scenario, setting, timed_cells, duration);
          const double error = relative_error(motion, reference, cell.position);
          results.push_back(row_of(scenario, "time", cell.model.vertices(), setting, motion, error));
          report(results.back());
        }
      }
    }
  }
}

/// How much longer the cell has become at each sample, um.
std::vector<double> growth_of(const RestingCell& cell, const Motion& motion) {
  double least = 0, largest = 0;
  for (std::size_t i = 0; i < cell.position.size(); i += 3) {
    least = std::min(least, cell.position[i]);
    largest = std::max(largest, cell.position[i]);
  }
  std::vector<double> growth;
  for (const double extent : motion.extents) growth.push_back(extent - (largest - least));
  return growth;
}

/// Growth of the stretched cell on coarser meshes against that on the finest: largest difference at any sample over
/// the largest growth.
void add_mesh_study(const Plan& plan, Json& results) {
  const std::vector<int> meshes = plan.quick ? std::vector<int>{66, 258} : std::vector<int>{66, 258, 1026, 4098};
  const double duration = plan.quick ? 20 : 160;
  Setting setting;
  setting.integrator = 1, setting.time_step = 1;
  setting.tolerance = 1e-4;  // forces on the vertices of fine meshes are small
  setting.lone_cells = true;
  const RestingCell fine_cell = resting_cell(meshes.back());
  const std::vector<double> finest = growth_of(fine_cell, run(fine_cell, scenarios[0], setting, 1, duration));
  const double most = *std::max_element(finest.begin(), finest.end());
  setting.lone_cells = false;
  for (std::size_t k = 0; k + 1 < meshes.size(); ++k) {
    const RestingCell cell = resting_cell(meshes[k]);
    const Motion motion = run(cell, scenarios[0], setting, timed_cells, duration);
    const std::vector<double> growth = growth_of(cell, motion);
    double error = 0;
    for (std::size_t i = 0; i < growth.size(); ++i) error = std::max(error, std::abs(growth[i] - finest[i]) / most);
    results.push_back(row_of(scenarios[0], "mesh", meshes[k], setting, motion, error));
    report(results.back());
  }
}

}  // namespace

Json measure_work_precision(const Plan& plan) {
  Json results = Json::array();
  const RestingCell cell = resting_cell(plan.quick ? 66 : 258);
  for (const Scenario& scenario : scenarios) add_time_study(plan, cell, scenario, results);
  add_mesh_study(plan, results);
  const Json best = recommended(results);
  if (best.is_null()) {
    std::printf("no setting keeps the error below 1 %% of the motion in both scenarios\n");
  } else {
    std::printf(
        "recommended: integrator %s, time step %g us, tolerance %g pN, precision %s: %.3g us per simulated us, "
        "error %.2g of the motion\n",
        best["integrator"].get<std::string>().c_str(), best["time_step_us"].get<double>(),
        best["tolerance_pN"].get<double>(), best["precision"].get<std::string>().c_str(),
        best["us_per_simulated_us"].get<double>(), best["relative_error"].get<double>());
  }
  return results;
}

}  // namespace npfem::app::bench
