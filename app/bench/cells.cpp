// SPDX-License-Identifier: MPL-2.0
#include "bench/cells.h"

#include <algorithm>
#include <cmath>

#include "interrupt.h"

namespace npfem::app::bench {
namespace {

constexpr double least_total_us = 5e4;
constexpr std::size_t most_repeats = 25;

/// Adds what the cells report of their last step.
void add_reports(const api::Batch& batch, Measurement& sums) {
  const auto mean = [](const auto& values) {
    double sum = 0;
    for (const auto value : values) sum += static_cast<double>(value);
    return sum / static_cast<double>(values.size());
  };
  sums.iterations += mean(batch.iterations());
  sums.evaluations += mean(batch.measure("evaluations"));
  sums.flops += mean(batch.measure("flops"));
  const std::vector<double> residual = batch.residual();
  sums.residual = std::max(sums.residual, *std::max_element(residual.begin(), residual.end()));
}

}  // namespace

int level_of(int vertices) {
  int level = 2;
  for (int n = 66; n < vertices; n = 4 * n - 6) ++level;
  return level;
}

api::Model red_cell(const std::string& material, int vertices) {
  api::Material parameters = api::Material::preset(material);
  if (!(parameters.number("solid_density") > 0)) parameters.set("membrane_density", 400);
  return {parameters.mesh(level_of(vertices)), parameters};
}

api::Batch make_batch(const api::Model& model, const Setting& setting, int cells) {
  api::Batch batch(model, setting.backend, cells);
  batch.set("time_step", setting.time_step);
  batch.set("integrator", setting.integrator);
  batch.set("tolerance", setting.tolerance);
  batch.set("precision", setting.precision);
  batch.set("threads", setting.threads);
  batch.set("matrix", setting.matrix);
  batch.set("lone_cells", setting.lone_cells ? 1 : 0);
  if (setting.to_the_end) batch.set("max_iterations", 5000);
  if (!setting.lineage) return batch;
  batch.set("method", std::string("lineage"));
  batch.set("lineage_beta", 0.01);
  batch.set("history", 5);
  batch.set("max_iterations", 30);
  batch.set("max_line_search", 5);
  if (setting.to_the_end) {
    batch.set("lineage_tolerance", 0);
    batch.set("lineage_attempts", 1000);
    batch.set("max_line_search", 20);
  }
  return batch;
}

Start sheared_start(const api::Model& model, int cells) {
  const double rate = 1e-3;  // 1/us
  const api::Batch one(model, "reference", 1);
  Start start{cells, {}, {}};
  std::vector<double> x(3 * static_cast<std::size_t>(model.vertices()));
  one.read("position", 0, 1, x);
  for (int c = 0; c < cells; ++c) {
    start.position.insert(start.position.end(), x.begin(), x.end());
    const double own = 1 + 0.1 * std::sin(c);
    for (std::size_t i = 0; i < x.size(); i += 3)
      start.velocity.insert(start.velocity.end(), {own * rate * x[i + 2], 0, 0.2 * rate * x[i]});
  }
  return start;
}

Start copies_of(std::span<const double> position, std::span<const double> velocity, int count) {
  Start start{count, {}, {}};
  for (int c = 0; c < count; ++c) {
    start.position.insert(start.position.end(), position.begin(), position.end());
    start.velocity.insert(start.velocity.end(), velocity.begin(), velocity.end());
  }
  return start;
}

void restore(api::Batch& batch, const Start& start) {
  batch.write("position", 0, start.cells, start.position);
  batch.write("velocity", 0, start.cells, start.velocity);
}

Measurement measure(api::Batch& batch, const Start& start, Clock clock, int steps, int repeats) {
  restore(batch, start);
  batch.step();  // makes the factors
  Measurement result;
  std::vector<double> times, wall_times;
  double total = 0;
  while (times.size() < static_cast<std::size_t>(repeats) || (total < least_total_us && times.size() < most_repeats)) {
    restore(batch, start);
    double us = 0, wall_us = 0;
    for (int s = 0; s < steps; ++s) {
      stop_if_interrupted();
      const Stopwatch watch(clock), wall(Clock::wall);
      const int failed = batch.step();
      us += watch.us(), wall_us += wall.us();
      result.failed_cells = std::max(result.failed_cells, failed);
      if (times.empty()) add_reports(batch, result);
    }
    times.push_back(us), wall_times.push_back(wall_us);
    total += us;
  }
  const double cell_steps = static_cast<double>(start.cells) * steps;
  result.us_per_cell_step = median(times) / cell_steps;
  result.wall_us_per_cell_step = median(wall_times) / cell_steps;
  result.iterations /= steps, result.evaluations /= steps, result.flops /= steps;
  const int compared = std::min(start.cells, first_cells);
  result.position.resize(start.position.size() / static_cast<std::size_t>(start.cells) *
                         static_cast<std::size_t>(compared));
  batch.read("position", 0, compared, result.position);
  return result;
}

double largest_distance(std::span<const double> a, std::span<const double> b) {
  double most = 0;
  for (std::size_t i = 0; i + 2 < std::min(a.size(), b.size()); i += 3)
    most = std::max(most, std::hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
  return most;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void stop_if_interrupted() {
  if (request() != Request::none) throw Interrupted{};
}

}  // namespace npfem::app::bench
