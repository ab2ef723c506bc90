// SPDX-License-Identifier: MPL-2.0
// The full length of HardCases.NothingMovesWithoutForces.
#include <gtest/gtest.h>

#include "hard_case.h"

namespace npfem {
namespace {

class IdleCell : public testing::HardCaseTest {};
INSTANTIATE_TEST_SUITE_P(BackEnds, IdleCell, testing::back_ends,
                         [](const auto& back_end) { return std::string(back_end.param); });

TEST_P(IdleCell, StaysForAMillionSteps) {
  Material material = Material::preset("rbc");
  material.set("solid_density", 1000);
  testing::Relaxed batch(std::make_shared<const Model>(build_model(evans_fung_cell(2), material)), back_end);
  const double volume = batch.measure("volume", 0), area = batch.measure("area", 0), x = batch.measure("centre_x", 0);
  EXPECT_EQ(batch.step(1000000), 0);
  EXPECT_NEAR(batch.measure("volume", 0), volume, 1e-12 * volume);
  EXPECT_NEAR(batch.measure("area", 0), area, 1e-12 * area);
  EXPECT_NEAR(batch.measure("centre_x", 0), x, 1e-12);
}

}  // namespace
}  // namespace npfem
