// SPDX-License-Identifier: MPL-2.0
// Runs of the lineage itself, repeated through shapeop.h: 258 vertices of a red cell, pulled at both ends. How far each
// can be matched was measured by perturbing the start of the lineage's own run (README.md beside the data).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lineage_body.h"
#include "npfem/npfem.hpp"

namespace {

struct RecordedRun {
  const char* name;
  int steps;
  double time_step, alpha, beta;
  unsigned max_iterations, line_search, attempts;
  double tolerance;
};
constexpr RecordedRun dynamic_50{"rbc_dynamic_50pN", 300, 0.25, 0.9, 0.01, 30, 5, 7, 1e-5};
constexpr RecordedRun quasistatic_50{"rbc_quasistatic_50pN", 60, 1000, 0.5, 1.0, 1000, 15, 50, 1e-6};
constexpr RecordedRun quasistatic_150{"rbc_quasistatic_150pN", 60, 1000, 0.5, 1.0, 1000, 15, 50, 1e-6};

/// What a recorded run and its repetition differ by, um.
struct Difference {
  double x_extent = 0;  ///< largest over the steps
  double extent = 0;    ///< largest over the steps and axes
  double position = 0;  ///< largest component at the end
};

class ReferenceRuns : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no recorded runs at " << shared_data();
    solver_ = shapeop_create();
    ASSERT_TRUE(load_body(solver_, shared_data() / "Case_Studies" / "RBC_Surface_mesh_258SurfVer"));
  }
  void TearDown() override {
    if (solver_) shapeop_delete(solver_);
  }

  Difference repeat(const RecordedRun& run) {
    const auto folder = shared_data() / "reference_runs";
    const auto final_state = read_rows(folder / (std::string(run.name) + "_final.csv"));
    const auto extents = read_rows(folder / (std::string(run.name) + "_extent.csv"));
    EXPECT_EQ(extents.size(), static_cast<std::size_t>(run.steps));
    for (std::size_t i = 0; i < final_state.size(); ++i) {
      std::array<double, 3> force{final_state[i][0], final_state[i][1], final_state[i][2]};
      shapeop_addVertexForce(solver_, force.data(), static_cast<int>(i));
    }
    EXPECT_EQ(shapeop_initDynamic(solver_, run.alpha, run.beta, run.time_step, 1125, false, true, 250), 0);

    Difference difference;
    std::vector<double> xyz(3 * final_state.size());
    for (int s = 0; s < run.steps; ++s) {
      EXPECT_EQ(shapeop_solve(solver_, 7, run.max_iterations, run.line_search, run.attempts, 5, run.tolerance, 1e-4,
                              0.9, 0, 0),
                0);
      shapeop_getPoints(solver_, xyz.data(), static_cast<int>(final_state.size()));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double departure = std::abs(extent(xyz, axis) - extents[static_cast<std::size_t>(s)][1 + axis]);
        difference.extent = std::max(difference.extent, departure);
        if (axis == 0) difference.x_extent = std::max(difference.x_extent, departure);
      }
    }
    for (std::size_t i = 0; i < xyz.size(); ++i) {
      difference.position = std::max(difference.position, std::abs(xyz[i] - final_state[i / 3][3 + i % 3]));
    }
    RecordProperty("position_um", std::to_string(difference.position));
    std::printf("  %s: largest difference in position %.2e um, in extent %.2e um (x: %.2e)\n", run.name,
                difference.position, difference.extent, difference.x_extent);
    return difference;
  }

  ShapeOpSolver* solver_ = nullptr;

 private:
  static double extent(const std::vector<double>& xyz, std::size_t axis) {
    double least = xyz[axis], most = xyz[axis];
    for (std::size_t i = axis; i < xyz.size(); i += 3) {
      least = std::min(least, xyz[i]);
      most = std::max(most, xyz[i]);
    }
    return most - least;
  }
};

TEST_F(ReferenceRuns, ABatchInLineageModeTakesTheSameStepsBitForBit) {
  const auto folder = shared_data() / "Case_Studies" / "RBC_Surface_mesh_258SurfVer";
  const npfem::api::Model model = npfem::api::Model::load_lineage(folder.string(), 1125, 250);
  npfem::api::Batch batch(model, "cpu", 1);
  batch.set("method", std::string("lineage"));
  batch.set("lone_cells", 1);
  batch.set("time_step", 0.25);
  batch.set("lineage_alpha", 0.9);
  batch.set("lineage_beta", 0.01);
  batch.set("history", 5);
  batch.set("max_iterations", 30);
  batch.set("max_line_search", 5);
  std::vector<double> force(3 * 258, 0.0), stepped(force), solved(force);
  force[0] = 50;
  batch.write("external_force", 0, 1, force);
  shapeop_addVertexForce(solver_, force.data(), 0);
  ASSERT_EQ(shapeop_initDynamic(solver_, 0.9, 0.01, 0.25, 1125, false, true, 250), 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(batch.step(), 0);
    EXPECT_EQ(shapeop_solve(solver_, 7, 30, 5, 7, 5, 1e-5, 1e-4, 0.9, 0, 0), 0);
  }
  batch.read("position", 0, 1, stepped);
  shapeop_getPoints(solver_, solved.data(), 258);
  EXPECT_EQ(stepped, solved);
  EXPECT_NE(stepped, model.get("rest_position"));
}

TEST_F(ReferenceRuns, DynamicStretchMatchesInEveryPosition) {
  const Difference difference = repeat(dynamic_50);
  EXPECT_LT(difference.position, 1e-6);
  EXPECT_LT(difference.extent, 1e-6);
}

TEST_F(ReferenceRuns, QuasistaticStretchAt150PnMatchesInEveryPosition) {
  EXPECT_LT(repeat(quasistatic_150).position, 1e-4);
}

TEST_F(ReferenceRuns, QuasistaticStretchAt50PnMatchesInItsLength) {
  EXPECT_LT(repeat(quasistatic_50).x_extent, 0.02);
}

}  // namespace
