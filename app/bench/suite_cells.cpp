// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "bench/cells.h"
#include "bench/machine.h"
#include "bench/suites.h"

namespace npfem::app::bench {
namespace {

constexpr int repeats = 5;
constexpr int cells_per_thread = 32;  ///< with fewer, threads would have nothing to do

/// One material on one mesh: the solutions to compare with, and the tolerance that is as good as the lineage.
class Case {
 public:
  Case(const std::string& material, int vertices, int steps)
      : model_(red_cell(material, vertices)), steps_(steps), start_(sheared_start(model_, first_cells)) {
    Setting exact;
    exact.tolerance = 1e-9;
    exact_ = positions_after_steps(exact);
    exact.lineage = exact.to_the_end = true;
    exact_lineage_ = positions_after_steps(exact);
    for (int precision = 0; precision < 3; ++precision) choose_tolerance(precision);
  }

  const api::Model& model() const { return model_; }
  int steps() const { return steps_; }
  double tolerance(int precision) const { return tolerance_[precision]; }
  double error(const Setting& setting, const std::vector<double>& position) const {
    return largest_distance(position, setting.lineage ? exact_lineage_ : exact_);
  }
  /// Time of a step in the back end "reference", us.
  double reference_us(const Setting& setting) {
    auto& known = reference_us_[setting.lineage ? 0 : setting.tolerance];
    if (!known) {
      Setting reference = setting;
      reference.backend = "reference", reference.precision = 0, reference.threads = 1, reference.lone_cells = false;
      api::Batch batch = make_batch(model_, reference, 1);
      known = measure(batch, sheared_start(model_, 1), Clock::cpu, steps_, repeats).us_per_cell_step;
    }
    return *known;
  }

 private:
  std::vector<double> positions_after_steps(const Setting& setting) const {
    api::Batch batch = make_batch(model_, setting, first_cells);
    restore(batch, start_);
    for (int s = 0; s < steps_; ++s) {
      stop_if_interrupted();
      batch.step();
    }
    std::vector<double> position(start_.position.size());
    batch.read("position", 0, first_cells, position);
    return position;
  }

  /// The largest tolerance of the default method at which its error is not above the lineage's; where there is none,
  /// the largest with the least error.
  void choose_tolerance(int precision) {
    Setting setting;
    setting.precision = precision, setting.lineage = true;
    const double allowed = error(setting, positions_after_steps(setting));
    setting.lineage = false;
    double least = std::numeric_limits<double>::infinity();
    for (const double tolerance : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 1e-4}) {
      setting.tolerance = tolerance;
      const double found = error(setting, positions_after_steps(setting));
      if (!(found < least)) continue;
      least = found, tolerance_[precision] = tolerance;
      if (found <= allowed) break;
    }
    char line[200];
    std::snprintf(line, sizeof line, "%s, error after %d steps: lineage %.2g um, default %.2g um at tolerance %g pN",
                  precision_names[static_cast<std::size_t>(precision)].c_str(), steps_, allowed, least,
                  tolerance_[precision]);
    say(line);
  }

  api::Model model_;
  int steps_;
  Start start_;
  std::vector<double> exact_, exact_lineage_;
  double tolerance_[3] = {};                              ///< by precision
  std::map<double, std::optional<double>> reference_us_;  ///< by tolerance; 0: lineage
};

struct Row {
  std::string material;
  int vertices, cells;
  Setting setting;
};

Json measure_row(const Row& row, Case& of, const FmaPeak& peak) {
  const Setting& s = row.setting;
  const Start start = sheared_start(of.model(), row.cells);
  const double heap_before = heap_bytes();
  api::Batch batch = make_batch(of.model(), s, row.cells);
  const Clock clock = clock_for(s.threads);
  const Measurement m = measure(batch, start, clock, of.steps(), repeats);
  const double heap = heap_bytes() - heap_before;
  const double peak_gflops = (s.precision == 2 ? peak.float_gflops : peak.double_gflops) * s.threads;
  const double gflops = 1e-3 * m.flops / m.us_per_cell_step;
  return {{"material", row.material},
          {"mesh", row.vertices},
          {"method", s.lineage ? "lineage" : "default"},
          {"precision", precision_names[static_cast<std::size_t>(s.precision)]},
          {"batch", row.cells},
          {"lone_cells", s.lone_cells},
          {"threads", s.threads},
          {"clock", name_of(clock)},
          {"time_step_us", s.time_step},
          {"tolerance_pN", s.lineage ? Json(nullptr) : Json(s.tolerance)},
          {"us_per_cell_step", m.us_per_cell_step},
          {"wall_us_per_cell_step", m.wall_us_per_cell_step},
          {"cell_steps_per_s_per_core", 1e6 / (m.us_per_cell_step * s.threads)},
          {"iterations", m.iterations},
          {"evaluations", m.evaluations},
          {"residual_pN", m.residual},
          {"failed_cells", m.failed_cells},
          {"flops_per_cell_step", m.flops},
          {"gflops", gflops},
          {"peak_gflops", peak_gflops},
          {"fraction_of_peak", gflops / peak_gflops},
          {"ratio_to_reference", of.reference_us(s) / m.us_per_cell_step},
          {"error_um", of.error(s, m.position)},
          {"bytes_per_cell", heap / row.cells}};
}

/// All rows of one material on one mesh. Materials other than the lineage's own are measured in one batch size.
std::vector<Row> rows_of(const Plan& plan, const std::string& material, int vertices, const Case& of) {
  const bool brief = material != "palabos-rbc";
  std::vector<Row> rows;
  for (const bool lineage : {true, false}) {
    for (const int precision : plan.precisions) {
      Setting setting;
      setting.lineage = lineage, setting.precision = precision, setting.tolerance = of.tolerance(precision);
      setting.lone_cells = true;
      rows.push_back({material, vertices, 1, setting});
      setting.lone_cells = false;
      for (const int cells : plan.batches) {
        if (brief && cells != plan.batches[plan.batches.size() / 2]) continue;
        for (const int threads : plan.threads) {
          if (threads > 1 && cells < cells_per_thread * threads) continue;
          setting.threads = threads;
          rows.push_back({material, vertices, cells, setting});
        }
      }
    }
  }
  return rows;
}

std::string line_of(const Json& row) {
  char line[200];
  std::snprintf(line, sizeof line, "%-12s %5d  %-7s  %-6s %5d%s %2d  %9.2f %6.2f %6.2f %9.1e %7.1f %5.1f %8.1f %9.1e",
                row["material"].get<std::string>().c_str(), row["mesh"].get<int>(),
                row["method"].get<std::string>().c_str(), row["precision"].get<std::string>().c_str(),
                row["batch"].get<int>(), row["lone_cells"].get<bool>() ? " lone" : "     ", row["threads"].get<int>(),
                row["us_per_cell_step"].get<double>(), row["iterations"].get<double>(),
                row["evaluations"].get<double>(), row["residual_pN"].get<double>(), row["gflops"].get<double>(),
                100 * row["fraction_of_peak"].get<double>(), row["ratio_to_reference"].get<double>(),
                row["error_um"].get<double>());
  return line;
}

const char* const header =
    "material      mesh  method   prec.  batch      th  us/c-step   iter   eval  resid/pN GFLOP/s  %peak  x refer.  "
    "error/um";

/// The row of the lineage's red cell of 258 vertices on one thread; null where it was not measured.
const Json* find(const Json& results, const char* method, const char* precision, int cells, bool lone) {
  for (const Json& row : results) {
    if (row["material"] == "palabos-rbc" && row["mesh"] == 258 && row["method"] == method && row["batch"] == cells &&
        row["precision"] == precision && row["lone_cells"] == lone && row["threads"] == 1)
      return &row;
  }
  return nullptr;
}

void print_summary(const Json& results) {
  for (const char* method : {"lineage", "default"}) {
    for (const std::string& precision : precision_names) {
      const Json* few = find(results, method, precision.c_str(), 64, false);
      const Json* many = find(results, method, precision.c_str(), 4096, false);
      const Json* lone = find(results, method, precision.c_str(), 1, true);
      if (!few || !many || !lone) continue;
      std::printf(
          "%-7s %-6s: %.1f us per step, %.0f %% of the peak, error %.1e um; 4096 cells cost %.2f x 64; "
          "%.0f kB per cell; a lone cell %.3f ms\n",
          method, precision.c_str(), (*few)["us_per_cell_step"].get<double>(),
          100 * (*few)["fraction_of_peak"].get<double>(), (*few)["error_um"].get<double>(),
          (*many)["us_per_cell_step"].get<double>() / (*few)["us_per_cell_step"].get<double>(),
          1e-3 * (*many)["bytes_per_cell"].get<double>(), 1e-3 * (*lone)["us_per_cell_step"].get<double>());
    }
  }
}

}  // namespace

Json measure_cells(const Plan& plan) {
  Json results = Json::array();
  say(header);
  std::printf("%s\n", header);
  for (const char* material : {"palabos-rbc", "rbc"}) {
    if (plan.quick && !results.empty()) break;
    for (const int vertices : plan.meshes) {
      Case of(material, vertices, plan.quick ? 2 : 4);
      for (const Row& row : rows_of(plan, material, vertices, of)) {
        results.push_back(measure_row(row, of, plan.peak));
        const std::string line = line_of(results.back());
        say(line);
        const bool shown = vertices == 258 && (row.setting.lone_cells || row.cells == 64) && row.setting.threads == 1;
        if (shown || plan.quick) std::printf("%s\n", line.c_str());
      }
    }
  }
  print_summary(results);
  return results;
}

}  // namespace npfem::app::bench
