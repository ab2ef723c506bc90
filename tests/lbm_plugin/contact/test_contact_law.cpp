// SPDX-License-Identifier: MPL-2.0
#include "contact/contact_law.h"

#include <gtest/gtest.h>

namespace npfem::flow {
namespace {

constexpr ContactLaw repulsion{0.8, 5.0, 0, 0};     // um, Pa
constexpr ContactLaw sticky{0.4, 20.0, 3.0, 0.05};  // and uN/m, um

TEST(ContactLaw, IsFullAtTouchAndFadesSmoothlyToItsRange) {
  EXPECT_DOUBLE_EQ(repulsion.traction(0), 5.0);
  EXPECT_DOUBLE_EQ(repulsion.traction(0.4), 1.25);
  EXPECT_EQ(repulsion.traction(0.8), 0);
  EXPECT_EQ(repulsion.traction(2.0), 0);
  EXPECT_LT(repulsion.traction(0.8 - 1e-6), 1e-10) << "the slope is continuous, too";
}

TEST(ContactLaw, GrowsBehindTheSurfaceUpToOneRange) {
  EXPECT_DOUBLE_EQ(repulsion.traction(-0.4), 5.0 * 2.25);
  EXPECT_DOUBLE_EQ(repulsion.traction(-0.8), 20.0);
  EXPECT_DOUBLE_EQ(repulsion.traction(-3.0), 20.0);
}

TEST(ContactLaw, AttractionCostsItsDepthToPart) {
  double work = 0;
  constexpr int steps = 4000;
  const double width = (sticky.reach() - sticky.range) / steps;
  for (int i = 0; i < steps; ++i) work -= width * sticky.traction(sticky.range + (i + 0.5) * width);
  EXPECT_NEAR(work, sticky.depth, 1e-6 * sticky.depth);
  EXPECT_EQ(sticky.traction(sticky.range), 0);
  EXPECT_EQ(sticky.traction(sticky.reach()), 0);
  EXPECT_LT(sticky.traction(sticky.range + 0.03), 0);
}

TEST(ContactLaw, SlopeBoundsTheStiffness) {
  constexpr double h = 1e-6;
  for (double d = -0.79; d < 0.79; d += 0.013) {
    const double slope = -(repulsion.traction(d + h) - repulsion.traction(d - h)) / (2 * h);
    EXPECT_NEAR(repulsion.slope(d), slope, 1e-5);
  }
  for (double d = -0.39; d < 0.7; d += 0.0031) {
    const double slope = -(sticky.traction(d + h) - sticky.traction(d - h)) / (2 * h);
    EXPECT_GE(sticky.slope(d), slope - 1e-3) << d;
    EXPECT_GE(sticky.slope(d), 0);
  }
}

TEST(ContactLaw, OfNoRangeDoesNothing) {
  EXPECT_FALSE(ContactLaw{}.active());
  EXPECT_EQ((ContactLaw{0, 5, 1, 0.1}).traction(-0.1), 0);
}

}  // namespace
}  // namespace npfem::flow
