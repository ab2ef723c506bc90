// SPDX-License-Identifier: MPL-2.0
#include "geometry/tweezers_load.h"

#include <gtest/gtest.h>

#include <cmath>

namespace npfem::flow {
namespace {

// Two vertices at each end of a bar along x, one off the line, and one in the middle, as the hollow of a red cell.
const std::vector<double> bar{-4, 0, 0, -3.9, 0.5, 0, 4, 0, 0, 3.9, 0, -0.6, 3, 2, 0, -3, -2, 0, 0, 0, 0.1, 0, 0, -0.1};

TEST(TweezersLoad, IsSharedByTheEnds) {
  const std::vector<double> load = tweezers_load(bar, 50, 2);
  const std::vector<double> expected{-25, 0, 0, -25, 0, 0, 25, 0, 0, 25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(load, expected);
}

TEST(TweezersLoad, IsNoneWhereNoVertexIsUnderABead) {
  EXPECT_TRUE(tweezers_load({{-4, 1, 1, 4, 0, 0, 0, 2, 0, 0, -2, 0, 0, 0, 2, 0, 0, -2}}, 50, 1).empty());
}

}  // namespace
}  // namespace npfem::flow
