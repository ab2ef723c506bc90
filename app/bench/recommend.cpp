// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <array>
#include <map>

#include "bench/suites.h"
#include "bench/svg_plot.h"

namespace npfem::app::bench {

Json recommended(const Json& work_precision) {
  constexpr double allowed_error = 0.01;
  std::map<std::string, Json> settings;  // by what a user would set
  for (const Json& row : work_precision) {
    if (row.at("study") != "time") continue;
    Json setting{{"integrator", row.at("integrator")},
                 {"time_step_us", row.at("time_step_us")},
                 {"tolerance_pN", row.at("tolerance_pN")},
                 {"precision", row.at("precision")}};
    Json& known = settings[setting.dump()];
    if (known.is_null()) {
      known = setting;
      known["us_per_simulated_us"] = 0.0, known["relative_error"] = 0.0;
    }
    // Mean time of the two scenarios (halved below); the worst error counts.
    known["us_per_simulated_us"] =
        known["us_per_simulated_us"].get<double>() + row.at("us_per_simulated_us").get<double>();
    const double error = row.at("failed_cells") == 0 ? row.at("relative_error").get<double>() : 1e300;
    known["relative_error"] = std::max(known["relative_error"].get<double>(), error);
  }
  Json best;
  for (const auto& [key, setting] : settings) {
    if (setting["relative_error"].get<double>() > allowed_error) continue;
    if (best.is_null() || setting["us_per_simulated_us"] < best["us_per_simulated_us"]) best = setting;
  }
  if (!best.is_null()) best["us_per_simulated_us"] = best["us_per_simulated_us"].get<double>() / 2;
  return best;
}

namespace {

bool agrees(const Json& row, const Json& setting) {
  if (setting.is_null()) return false;
  for (const char* key : {"integrator", "time_step_us", "tolerance_pN", "precision"}) {
    if (row.at(key) != setting.at(key)) return false;
  }
  return true;
}

Point2 point_of(const Json& row) {
  return {row.at("us_per_simulated_us").get<double>(), row.at("relative_error").get<double>()};
}

}  // namespace

std::string plot_work_precision(const Json& work_precision) {
  const std::vector<std::array<const char*, 3>> looks{{"euler", "double", "#8c9aa8"}, {"euler", "mixed", "#c2ccd4"},
                                                      {"euler", "float", "#dcc9b0"},  {"bdf2", "double", "#1f5f8b"},
                                                      {"bdf2", "mixed", "#b3202c"},   {"bdf2", "float", "#d98a1f"}};
  const Json best = recommended(work_precision);
  const std::string cell = "red cell, " + work_precision.at(0).at("mesh").dump() + " vertices: ";
  std::vector<Panel> panels;
  for (const char* scenario : {"stretch", "shear"}) {
    Panel panel{cell + scenario, "time per cell and simulated us (us)", "largest error / largest displacement", {}, {},
                "recommended"};
    for (const auto& [integrator, precision, colour] : looks) {
      Series series{std::string(integrator) + ", " + precision, colour, {}};
      for (const Json& row : work_precision) {
        if (row.at("study") != "time" || row.at("scenario") != scenario || row.at("failed_cells") != 0) continue;
        if (row.at("integrator") != integrator || row.at("precision") != precision) continue;
        series.points.push_back(point_of(row));
        if (agrees(row, best)) panel.marks.push_back(point_of(row));
      }
      if (!series.points.empty()) panel.series.push_back(std::move(series));
    }
    panels.push_back(std::move(panel));
  }
  return svg_plot(panels);
}

}  // namespace npfem::app::bench
