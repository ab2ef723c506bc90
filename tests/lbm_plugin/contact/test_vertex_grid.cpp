// SPDX-License-Identifier: MPL-2.0
#include "contact/vertex_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flows.h"

namespace npfem::flow {
namespace {

double nearest_image_distance(const Decomposition& split, const std::vector<double>& p, std::size_t a, std::size_t b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    double d = p[3 * a + i] - p[3 * b + i];
    const double period = split.nodes()[i];
    if (split.periodic(axis)) d -= period * std::round(d / period);
    sum += d * d;
  }
  return std::sqrt(sum);
}

/// Every pair within reach is met exactly once from each side, by comparison with all pairs.
void expect_all_pairs_met(const Decomposition& split, int rank, double reach) {
  const Box own = split.box(rank);
  std::vector<double> positions;
  for (int v = 0; v < 500; ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Within the window of the rank, in any image.
      const double inside = own.begin[axis] - 2 +
                            (own.size(static_cast<int>(axis)) + 4) *
                                (0.5 + 0.5 * flows::random_value(v, static_cast<std::int64_t>(axis)));
      const int image = split.periodic(static_cast<int>(axis)) ? v % 5 - 2 : 0;
      positions.push_back(inside + image * split.nodes()[axis]);
    }
  }
  VertexGrid grid(split, own, reach);
  grid.fill(positions);
  std::size_t pairs = 0;
  for (std::size_t a = 0; a < 500; ++a) {
    std::vector<std::size_t> met;
    grid.visit_near(a, [&](std::size_t b) { met.push_back(b); });
    std::sort(met.begin(), met.end());
    EXPECT_EQ(std::adjacent_find(met.begin(), met.end()), met.end()) << "a vertex was met twice";
    for (std::size_t b = 0; b < 500; ++b) {
      if (nearest_image_distance(split, positions, a, b) > reach) continue;
      ++pairs;
      EXPECT_TRUE(std::binary_search(met.begin(), met.end(), b));
    }
  }
  EXPECT_GT(pairs, 700u) << "too few pairs to mean anything";
}

TEST(VertexGrid, MeetsEveryPairWithinReachOnce) {
  expect_all_pairs_met(Decomposition({10, 9, 8}, {true, true, true}, 1), 0, 1.0);
  expect_all_pairs_met(Decomposition({10, 9, 8}, {true, false, true}, 1), 0, 2.0);
  expect_all_pairs_met(Decomposition({30, 9, 8}, {true, true, true}, 3), 1, 1.0);
  expect_all_pairs_met(Decomposition({30, 9, 8}, {true, false, false}, 3), 0, 1.3);
  expect_all_pairs_met(Decomposition({4, 9, 4}, {true, true, true}, 1), 0, 1.9);  // two cubes across
}

TEST(VertexGrid, KeepsVerticesThatHaveLeftThroughAWall) {
  const Decomposition split({10, 9, 8}, {true, false, true}, 1);
  VertexGrid grid(split, split.box(0), 1.0);
  grid.fill(std::vector<double>{1, -50, 1, 1, -50.2, 1, 1, 1e9, 1});
  int met = 0;
  grid.visit_near(0, [&](std::size_t) { ++met; });
  EXPECT_EQ(met, 2);
}

}  // namespace
}  // namespace npfem::flow
