// SPDX-License-Identifier: MPL-2.0
// Runs of the lineage's own program (Palabos-npFEM 2026-01, double), reproduced. How far each can be matched at all was
// measured by perturbing its start (see the README of the shared data).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "backend/cpu/dispatch.h"
#include "batch/batch.h"
#include "mesh/lineage_body.h"
#include "model/lineage_model.h"

namespace npfem {
namespace {

const std::string data = std::string(NPFEM_SHARED) + "/data/palabos-npfem";

std::vector<std::vector<double>> read_table(const std::string& path) {
  std::vector<std::vector<double>> rows;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    rows.emplace_back(std::istream_iterator<double>(numbers), std::istream_iterator<double>());
  }
  return rows;
}

struct Deviation {
  double position, extent;  ///< um
};

/// By back end.
class LineageRun : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (std::filesystem::exists(data)) return;
    std::cout << "skipped: " << data << " is absent\n";
    GTEST_SKIP();
  }

  static Deviation reproduce(const std::string& name, int steps, const SolverOptions& options) {
    const auto body = read_lineage_body(data + "/Case_Studies/RBC_Surface_mesh_258SurfVer");
    Batch batch(std::make_shared<const Model>(build_lineage_model(body, {1125, 250})), GetParam(), 1);
    batch.options() = options;
    std::vector<double> force, recorded;
    for (const auto& row : read_table(data + "/reference_runs/" + name + "_final.csv")) {
      force.insert(force.end(), row.begin(), row.begin() + 3);
      recorded.insert(recorded.end(), row.begin() + 3, row.end());
    }
    batch.write(Field::external_force, 0, 1, force);
    const auto extents = read_table(data + "/reference_runs/" + name + "_extent.csv");
    EXPECT_EQ(extents.size(), static_cast<std::size_t>(steps));
    Deviation worst{0, 0};
    for (int s = 0; s < steps; ++s) {
      EXPECT_EQ(batch.step(1), 0);
      worst.extent =
          std::max(worst.extent, std::abs(batch.measure("extent_x", 0) - extents[static_cast<std::size_t>(s)][1]));
    }
    std::vector<double> x(recorded.size());
    batch.read(Field::position, 0, 1, x);
    for (std::size_t i = 0; i < x.size(); ++i) worst.position = std::max(worst.position, std::abs(x[i] - recorded[i]));
    std::cout << name << ": positions within " << worst.position << " um, x extent within " << worst.extent << " um\n";
    return worst;
  }

  static SolverOptions dynamic_options() {
    SolverOptions o;
    o.lineage = true;
    o.time_step = 0.25;
    o.lineage_alpha = 0.9;
    o.lineage_beta = 0.01;
    o.history = 5;  // the lineage's m = 7
    o.max_iterations = 30;
    o.max_line_search = 5;
    return o;
  }
  static SolverOptions quasistatic_options() {
    SolverOptions o = dynamic_options();
    o.time_step = 1000;
    o.lineage_alpha = 0.5;
    o.lineage_beta = 1;
    o.max_iterations = 1000;
    o.max_line_search = 15;
    o.lineage_attempts = 50;
    o.lineage_tolerance = 1e-6;
    return o;
  }
};

INSTANTIATE_TEST_SUITE_P(BackEnds, LineageRun, ::testing::Values("reference", "cpu"));

/// How the back end "cpu" takes the dynamic run, by instruction set.
class LineageRunInLanes : public LineageRun {
 protected:
  static std::vector<double> end_of_dynamic_run(const std::string& back_end, int precision, int lone) {
    const auto body = read_lineage_body(data + "/Case_Studies/RBC_Surface_mesh_258SurfVer");
    Batch batch(std::make_shared<const Model>(build_lineage_model(body, {1125, 250})), back_end, 1);
    batch.options() = dynamic_options();
    batch.options().precision = precision;
    batch.options().lone_cells = lone;
    std::vector<double> force;
    for (const auto& row : read_table(data + "/reference_runs/rbc_dynamic_50pN_final.csv"))
      force.insert(force.end(), row.begin(), row.begin() + 3);
    batch.write(Field::external_force, 0, 1, force);
    EXPECT_EQ(batch.step(300), 0);
    std::vector<double> x(force.size());
    batch.read(Field::position, 0, 1, x);
    return x;
  }
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, LineageRunInLanes, ::testing::Values("avx512", "avx2", "baseline"));

TEST_P(LineageRunInLanes, Dynamic50pNIsThatOfTheReference) {
  const auto sets = cpu::instruction_sets();
  if (std::find(sets.begin(), sets.end(), GetParam()) == sets.end()) {
    std::cout << "skipped: this machine has no " << GetParam() << "\n";
    GTEST_SKIP();
  }
  const auto reference = end_of_dynamic_run("reference", 0, 0);
  const double bound[] = {1e-9, 1e-9, 1e-4};  // um, by precision
  for (const int precision : {0, 1, 2}) {
    for (const int lone : {0, 1}) {
      const auto found = end_of_dynamic_run("cpu-" + std::string(GetParam()), precision, lone);
      double worst = 0;
      for (std::size_t i = 0; i < found.size(); ++i) worst = std::max(worst, std::abs(found[i] - reference[i]));
      std::cout << GetParam() << ", precision " << precision << (lone ? ", lone" : ", in lanes") << ": within " << worst
                << " um of the reference\n";
      EXPECT_LT(worst, bound[precision]);
    }
  }
}

TEST_P(LineageRun, Dynamic50pN) {
  const Deviation d = reproduce("rbc_dynamic_50pN", 300, dynamic_options());
  EXPECT_LT(d.position, 1e-6);
  EXPECT_LT(d.extent, 1e-9);
}

TEST_P(LineageRun, Quasistatic150pN) {
  EXPECT_LT(reproduce("rbc_quasistatic_150pN", 60, quasistatic_options()).position, 1e-4);
}

TEST_P(LineageRun, Quasistatic50pN) {
  EXPECT_LT(reproduce("rbc_quasistatic_50pN", 60, quasistatic_options()).extent, 0.02);
}

}  // namespace
}  // namespace npfem
