// SPDX-License-Identifier: MPL-2.0
// Loads far beyond those of any flow. Each case ends converged within its bounds or in an error that names the cell and
// leaves it as it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"
#include "hard_case.h"

namespace npfem {
namespace {

using testing::cell_with;
using testing::drag_towards;
using testing::get;
using testing::named;
using testing::Relaxed;
using testing::Watch;

class HardLoads : public testing::HardCaseTest {};
INSTANTIATE_TEST_SUITE_P(BackEnds, HardLoads, testing::back_ends,
                         [](const auto& back_end) { return std::string(back_end.param); });

/// Two beads that touch the rim of the cell with discs 2 um wide and are pulled apart, as in the tweezers experiment.
class Beads {
 public:
  explicit Beads(Batch& batch) : batch_(batch) {
    const auto x = get(batch, Field::position);
    for (int i = 0; i < batch.model().num_vertices(); ++i) {
      const double* p = x.data() + 3 * i;
      if (std::hypot(p[1], p[2]) < 1.001 && std::abs(p[0]) > 2) side_[p[0] > 0].push_back(i);
    }
    for (const auto& side : side_) batch.add_patch(side, 1000);
  }
  void pull(double force_pN) {
    std::vector<double> force(3 * static_cast<std::size_t>(batch_.model().num_vertices()), 0.0);
    for (const int right : {0, 1}) {
      const double share = force_pN / static_cast<double>(side_[right].size());
      for (const int i : side_[right]) force[3 * static_cast<std::size_t>(i)] = right == 1 ? share : -share;
    }
    batch_.write(Field::external_force, 0, 1, force);
  }

 private:
  Batch& batch_;
  std::vector<int> side_[2];
};

TEST_P(HardLoads, StretchedBy1000pNAtRest) {
  Relaxed batch(testing::red_cell_model(3), back_end);
  Beads beads(batch);
  Watch watch(batch);
  double length = batch.measure("extent_x", 0);
  for (double force = 50; force <= 1000; force += 50) {
    beads.pull(force);
    EXPECT_EQ(batch.relax(), 0) << force;
    watch.look();
    EXPECT_GT(batch.measure("extent_x", 0), length);
    length = batch.measure("extent_x", 0);
  }
  EXPECT_EQ(watch.stopped_short(), 0);
  EXPECT_LT(watch.volume_error(), 0.05);
  EXPECT_LT(watch.area_error(), 0.05);
  watch.book("pulled by up to 1000 pN, relaxed", back_end, "converged");
}

TEST_P(HardLoads, StretchedBy1000pNWithoutATensionOfTheWholeArea) {
  Relaxed batch(cell_with("global_area_modulus", 0, 3), back_end);
  Beads beads(batch);
  Watch watch(batch);
  for (double force = 50; force <= 1000; force += 50) {
    beads.pull(force);
    EXPECT_EQ(batch.relax(), 0) << force;
    watch.look();
  }
  EXPECT_EQ(watch.stopped_short(), 0);
  EXPECT_NEAR(batch.measure("extent_x", 0), 25.1, 0.1);
  EXPECT_LT(watch.volume_error(), 0.1);
  watch.book("pulled by up to 1000 pN, no global area energy", back_end, "converged");
}

TEST_P(HardLoads, StretchedBy1000pNInTime) {
  Relaxed batch(testing::red_cell_model(3), back_end);
  Beads beads(batch);
  beads.pull(1000);
  batch.options().time_step = 5;
  Watch watch(batch);
  for (int step = 0; step < 100; ++step) {
    drag_towards(batch, testing::uniform(batch.model(), 0, 0, 0));
    EXPECT_EQ(batch.step(1), 0) << step;
    watch.look();
  }
  EXPECT_GT(batch.measure("extent_x", 0), 20);
  EXPECT_LT(watch.volume_error(), 0.05);
  EXPECT_LT(watch.area_error(), 0.05);
  watch.book("pulled by 1000 pN, in plasma", back_end, "converged");
}

/// A slit across the flow, 2.5 um wide over 8 um, that opens to 9 um on both sides; it runs along x.
struct Slit {
  static double ramp(double x) { return std::clamp((std::abs(x) - 4) / 6, 0.0, 1.0); }
  static double half_width(double x) { return 1.25 + 3.25 * ramp(x) * ramp(x) * (3 - 2 * ramp(x)); }
  static double slope(double x) { return std::copysign(3.25 * ramp(x) * (1 - ramp(x)), x); }
};

TEST_P(HardLoads, SqueezedThroughASlit) {
  // The walls are springs that a host puts on each vertex behind them; the plasma is driven through at 1 cm/s.
  const double wall_stiffness = 200;
  Relaxed batch(testing::red_cell_model(2), back_end);
  auto x = get(batch, Field::position);
  for (std::size_t i = 0; i < x.size(); i += 3) x[i] -= 14;
  batch.write(Field::position, 0, 1, x);
  batch.options().time_step = 2;
  Watch watch(batch);
  double thinnest = 100, deepest = 0;
  for (int s = 0; s < 1800; ++s) {
    x = get(batch, Field::position);
    std::vector<double> force(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); i += 3) {
      const double depth = std::abs(x[i + 1]) - Slit::half_width(x[i]);
      if (depth <= 0) continue;
      deepest = std::max(deepest, depth);
      force[i] = wall_stiffness * depth * Slit::slope(x[i]);
      force[i + 1] = -std::copysign(wall_stiffness * depth, x[i + 1]);
    }
    batch.write(Field::external_force, 0, 1, force);
    drag_towards(batch, testing::uniform(batch.model(), 0.01, 0, 0));
    batch.step(1);
    watch.look();
    thinnest = std::min(thinnest, batch.measure("extent_y", 0));
  }
  EXPECT_EQ(watch.failed() + watch.stopped_short(), 0);
  EXPECT_GT(batch.measure("centre_x", 0), 14) << "it did not pass";
  EXPECT_LT(thinnest, 2.6);
  EXPECT_LT(deepest, 0.15);
  EXPECT_LT(watch.volume_error(), 5e-3);
  EXPECT_LT(watch.area_error(), 5e-3);
  watch.book("through a slit 2.5 um wide (walls of springs)", back_end,
             named("converged, %.2f um at its thinnest", thinnest));
}

TEST_P(HardLoads, ShearOfAHundredThousandPerSecond) {
  Relaxed batch(testing::red_cell_model(3), back_end);
  Watch watch(batch);
  for (int s = 0; s < 100; ++s) {
    drag_towards(batch, testing::shear(get(batch, Field::position), 0.1));
    batch.step(1);
    watch.look();
  }
  EXPECT_EQ(watch.failed() + watch.stopped_short(), 0);
  EXPECT_LT(watch.volume_error(), 0.03);
  EXPECT_LT(watch.area_error(), 0.03);
  watch.book("shear flow 100000 1/s, 25 us", back_end, "converged");
}

TEST_P(HardLoads, NumbersThatAreNotFinite) {
  const auto model = testing::red_cell_model(2);
  Relaxed batch(model, back_end, 3), alone(model, back_end);
  for (int c = 0; c < 3; ++c) drag_towards(batch, testing::uniform(*model, 1e-3, 0, 0), c);
  drag_towards(alone, testing::uniform(*model, 1e-3, 0, 0));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto force = testing::uniform(*model, 0, 0, 0);
    force[16] = bad;
    try {
      batch.write(Field::external_force, 1, 1, force);
      FAIL();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("vertex 5 of cell 1"), std::string::npos) << e.what();
    }
  }
  Watch watch(batch, 1);
  for (const double huge : {1e100, 1e300}) {
    auto force = testing::uniform(*model, 0, 0, 0);
    force[16] = huge;
    batch.write(Field::external_force, 1, 1, force);
    const auto hash = batch.state_hash(1);
    EXPECT_EQ(batch.step(1), 1);
    EXPECT_TRUE(has_failed(batch.report(1).status));
    EXPECT_EQ(batch.state_hash(1), hash);
    EXPECT_NE(batch.status_text(1).find("cell 1 failed"), std::string::npos);
    alone.step(1);
    EXPECT_EQ(batch.state_hash(0), alone.state_hash(0));
    EXPECT_EQ(batch.state_hash(2), alone.state_hash(0));
    watch.look();
    watch.book(named("a force of %g pN on one vertex", huge), back_end, "error, state kept, others go on");
  }
}

}  // namespace
}  // namespace npfem
