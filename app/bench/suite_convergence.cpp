// SPDX-License-Identifier: MPL-2.0
#include <cmath>
#include <cstdio>

#include "bench/cells.h"
#include "bench/loads.h"
#include "bench/suites.h"

namespace npfem::app::bench {
namespace {

constexpr int steps = 10;

/// A cell held at some length by forces on its two ends.
struct HeldCell {
  double force;   ///< pN, on each end
  double extent;  ///< um
  std::vector<double> position, loads;
};

HeldCell held_by(const api::Model& model, double force) {
  api::Batch batch(model, "cpu", 1);
  batch.set("tolerance", 1e-3);
  HeldCell held{force, 0, std::vector<double>(3 * static_cast<std::size_t>(model.vertices())), {}};
  batch.read("position", 0, 1, held.position);
  held.loads = stretching_loads(held.position, model.get("rest_area"), force);
  batch.write("external_force", 0, 1, held.loads);
  batch.relax();
  batch.read("position", 0, 1, held.position);
  held.extent = batch.measure("extent_x")[0];
  return held;
}

/// Force by force until the cell is as long as asked for, to 2 %.
HeldCell held_at(const api::Model& model, double extent) {
  double low = 0, high = 50;
  HeldCell held = held_by(model, high);
  while (held.extent < extent && high < 3000) {
    stop_if_interrupted();
    low = high, high *= 2;
    held = held_by(model, high);
  }
  while (std::abs(held.extent - extent) > 0.02 * extent && high - low > 1e-3 * high) {
    stop_if_interrupted();
    const double middle = 0.5 * (low + high);
    held = held_by(model, middle);
    (held.extent < extent ? low : high) = middle;
  }
  return held;
}

/// Velocities of a shear of 1000 1/s at these positions.
std::vector<double> sheared(const std::vector<double>& x) {
  std::vector<double> v(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); i += 3) v[i] = 1e-3 * x[i + 2], v[i + 2] = 2e-4 * x[i];
  return v;
}

Measurement measure_held(const api::Model& model, const HeldCell& held, const Setting& setting, int cells) {
  const Start start = copies_of(held.position, sheared(held.position), cells);
  api::Batch batch = make_batch(model, setting, cells);
  for (int c = 0; c < cells; ++c) batch.write("external_force", c, 1, held.loads);
  return measure(batch, start, Clock::cpu, steps, setting.to_the_end ? 1 : 5);
}

Json measure_row(const std::string& material, const api::Model& model, const HeldCell& held, const Setting& setting,
                 const std::vector<double>& exact) {
  const Measurement m = measure_held(model, held, setting, first_cells);
  return {{"material", material},
          {"mesh", model.vertices()},
          {"state", held.force > 0 ? "stretched" : "rest"},
          {"extent_um", held.extent},
          {"force_pN", held.force},
          {"time_step_us", setting.time_step},
          {"matrix", setting.matrix == 1   ? "scalar"
                     : setting.matrix == 2 ? "hessian"
                                           : "chosen"},
          {"tolerance_pN", setting.tolerance},
          {"iterations", m.iterations},
          {"evaluations", m.evaluations},
          {"us_per_cell_step", m.us_per_cell_step},
          {"residual_pN", m.residual},
          {"failed_cells", m.failed_cells},
          {"error_um", largest_distance(m.position, exact)}};
}

void print(const Json& row) {
  char line[160];
  std::snprintf(line, sizeof line, "%-12s %6.2f um %6.2f us  %-8s %8.1f %8.1f %10.1f us %10.1e um %3d",
                row["material"].get<std::string>().c_str(), row["extent_um"].get<double>(),
                row["time_step_us"].get<double>(), row["matrix"].get<std::string>().c_str(),
                row["iterations"].get<double>(), row["evaluations"].get<double>(),
                row["us_per_cell_step"].get<double>(), row["error_um"].get<double>(), row["failed_cells"].get<int>());
  say(line);
  std::printf("%s\n", line);
}

}  // namespace

Json measure_convergence(const Plan& plan) {
  const int vertices = plan.quick ? 66 : 258;
  Json results = Json::array();
  std::printf("material     extent      step      matrix   iterations  evals       time       error failed\n");
  for (const char* material : {"palabos-rbc", "rbc"}) {
    const api::Model model = red_cell(material, vertices);
    std::vector<HeldCell> states{held_by(model, 0)};
    if (!plan.quick) states.push_back(held_at(model, 9)), states.push_back(held_at(model, 12));
    for (const HeldCell& held : states) {
      for (const double time_step : {0.25, 1.0, 5.0, 20.0}) {
        if (plan.quick && time_step > 1) continue;
        Setting setting;
        setting.time_step = time_step, setting.tolerance = 1e-7, setting.to_the_end = true;
        const std::vector<double> exact = measure_held(model, held, setting, first_cells).position;
        setting.tolerance = 1e-3, setting.to_the_end = false;
        for (const int matrix : {1, 2, 0}) {
          setting.matrix = matrix;
          results.push_back(measure_row(material, model, held, setting, exact));
          print(results.back());
        }
      }
    }
    if (plan.quick) break;
  }
  return results;
}

}  // namespace npfem::app::bench
