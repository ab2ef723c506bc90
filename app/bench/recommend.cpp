// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <array>
#include <map>

#include "bench/suites.h"
#include "bench/svg_plot.h"

namespace npfem::app::bench {
namespace {

constexpr std::array<const char*, 4> setting_keys{"integrator", "time_step_us", "tolerance_pN", "precision"};

}  // namespace

Json recommended(const Json& work_precision) {
  constexpr double allowed_error = 0.01;
  struct Total {
    Json setting;
    double us = 0, worst_error = 0;
    int scenarios = 0;
  };
  std::map<std::string, Total> totals;  // by what a user would set
  for (const Json& row : work_precision) {
    if (row.at("study") != "time") continue;
    Json setting;
    for (const char* key : setting_keys) setting[key] = row.at(key);
    Total& total = totals[setting.dump()];
    total.setting = setting;
    total.us += row.at("us_per_simulated_us").get<double>();
    total.worst_error = std::max(
        total.worst_error, row.at("failed_cells") == 0 ? row.at("relative_error").get<double>() : allowed_error * 2);
    ++total.scenarios;
  }
  const Total* best = nullptr;
  for (const auto& [key, total] : totals) {
    if (total.worst_error <= allowed_error && (!best || total.us < best->us)) best = &total;
  }
  if (!best) return nullptr;
  Json setting = best->setting;
  setting["us_per_simulated_us"] = best->us / best->scenarios;  // mean over the scenarios
  setting["relative_error"] = best->worst_error;
  return setting;
}

namespace {

bool agrees(const Json& row, const Json& setting) {
  if (setting.is_null()) return false;
  for (const char* key : setting_keys) {
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
