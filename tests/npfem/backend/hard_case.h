// SPDX-License-Identifier: MPL-2.0
// What a hard case is judged by, and the table that all of them fill.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cells.h"

namespace npfem::testing {

/// One line of the table.
struct HardCase {
  std::string name, back_end, outcome;
  int iterations = 0;       ///< most in one solve
  double volume_error = 0;  ///< worst after any solve, relative to the rest volume
  double area_error = 0;    ///< likewise, of the total area
};

/// The back ends that must pass every case.
inline const auto back_ends = ::testing::Values("reference", "cpu");

/// Fixture of a case, with the name of the back end as its parameter.
class HardCaseTest : public ::testing::TestWithParam<const char*> {
 protected:
  const char* back_end = GetParam();
};

/// All cases of this process. Printed at its end; written as Markdown to the file named by NPFEM_HARD_CASES.
std::vector<HardCase>& hard_cases();

/// Follows one cell of a batch through a case.
class Watch {
 public:
  explicit Watch(const Batch& batch, int cell = 0) : batch_(batch), cell_(cell) {}

  /// After each step or relaxation.
  void look() {
    const CellReport report = batch_.report(cell_);
    ++solves_;
    failed_ += has_failed(report.status) ? 1 : 0;
    short_ += report.status == CellStatus::iteration_cap ? 1 : 0;
    iterations_ = std::max(iterations_, report.iterations);
    volume_error_ = std::max(volume_error_, std::abs(batch_.measure("volume", cell_) / batch_.model().rest.volume - 1));
    area_error_ = std::max(area_error_, std::abs(batch_.measure("area", cell_) / batch_.model().rest.area - 1));
  }
  int failed() const { return failed_; }
  /// Solves that ended above the tolerance but within the bound.
  int stopped_short() const { return short_; }
  double volume_error() const { return volume_error_; }
  double area_error() const { return area_error_; }

  void book(const std::string& name, const std::string& back_end, const std::string& outcome) const {
    hard_cases().push_back({name, back_end, outcome, iterations_, volume_error_, area_error_});
  }

 private:
  const Batch& batch_;
  int cell_;
  int solves_ = 0, failed_ = 0, short_ = 0, iterations_ = 0;
  double volume_error_ = 0, area_error_ = 0;
};

/// Cells at rest.
struct Relaxed : Batch {
  Relaxed(std::shared_ptr<const Model> model, const char* back_end, int cells = 1)
      : Batch(std::move(model), back_end, cells) {
    EXPECT_EQ(relax(), 0);
  }
};

/// Elastic energy of the first cell, pN um.
inline double energy(Batch& batch) {
  batch.evaluate();
  return batch.measure("energy", 0);
}

/// A case's name with one number in it.
inline std::string named(const char* format, double number) {
  char name[96];
  std::snprintf(name, sizeof name, format, number);
  return name;
}

/// The shipped red cell with solid inside (1 fg/um3 is 1 kg/m3) or other properties.
inline std::shared_ptr<const Model> cell_with(const char* key, double value, int level = 2) {
  Material material = Material::preset("rbc");
  material.set(key, value);
  return std::make_shared<const Model>(build_model(evans_fung_cell(level), material));
}

/// Drag of the whole cell in plasma, fg/us: 6 pi eta a for eta = 1 mPa s, a = 4 um.
inline constexpr double cell_drag = 75000;

/// Couples a cell to a flow that it does not disturb: each vertex is dragged with its share of cell_drag towards the
/// velocity `flow` there, so that the result has a limit for short time steps. To be called before every step.
inline void drag_towards(Batch& batch, const std::vector<double>& flow, int cell = 0) {
  const Model& model = batch.model();
  const double per_area = cell_drag * batch.options().time_step / model.rest.area;
  std::vector<double> mass;
  for (const double area : model.vertex_area) mass.push_back(per_area * area);
  batch.write(Field::ambient_mass, cell, 1, mass);
  batch.write(Field::ambient_velocity, cell, 1, flow);
  batch.write(Field::held_force, cell, 1, std::vector<double>(flow.size(), 0.0));
}

}  // namespace npfem::testing
