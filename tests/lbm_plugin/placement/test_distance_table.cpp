// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cell_shapes.h"
#include "placement/distance_table.h"
#include "placement/random.h"
#include "placement/triangle_distance.h"

namespace npfem::flow {
namespace {

TEST(TriangleDistance, ToFaceEdgeAndCorner) {
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{0, 2, 0};
  EXPECT_DOUBLE_EQ(distance_to_triangle({0.5, 0.5, -3}, a, b, c), 3);
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, -2, 0}, a, b, c), 2);
  EXPECT_DOUBLE_EQ(distance_to_triangle({-3, -4, 0}, a, b, c), 5);
  EXPECT_DOUBLE_EQ(distance_to_triangle({2, 2, 0}, a, b, c), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(distance_to_triangle({5, 0, 4}, a, b, c), 5);
}

TEST(TriangleDistance, IsTheLeastOverManyPointsOfTheTriangle) {
  Random random(5);
  const auto point = [&] { return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  for (int n = 0; n < 50; ++n) {
    const Vec3 p = point(), a = point(), b = point(), c = point();
    double least = 10;
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; i + j <= 200; ++j) {
        const Vec3 q = add(a, add(scale(i / 200.0, subtract(b, a)), scale(j / 200.0, subtract(c, a))));
        least = std::min(least, norm(subtract(p, q)));
      }
    }
    const double distance = distance_to_triangle(p, a, b, c);
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_NEAR(distance, least, 0.02);
  }
}

TEST(DistanceTable, OfASphere) {
  const CellType ball = testing::sphere(2.0, 4);
  const DistanceTable table(ball.shape, ball.triangles, 0.5);
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    const double r = random.uniform(0.2, 3.0);
    const double distance = table.at(scale(r, random.direction()));
    // flat faces lie up to 0.005 um inside the sphere, and the kink at the band is rounded by a quarter of a node
    // spacing
    EXPECT_NEAR(distance, std::clamp(r - 2.0, -0.5, 0.5), 0.02) << "r = " << r;
  }
  EXPECT_EQ(table.at({100, 0, 0}), 0.5);
}

TEST(DistanceTable, KnowsTheDimpleOfARedCell) {
  const CellType cell = testing::red_cell(4);
  const DistanceTable table(cell.shape, cell.triangles, 0.3);
  EXPECT_LT(table.at({0, 0, 0}), -0.25);     // half the thickness in the middle is 0.4 um
  EXPECT_GT(table.at({0, 0, 0.9}), 0.25);    // above the dimple, below the rim
  EXPECT_LT(table.at({2.8, 0, 0.9}), -0.1);  // inside the rim at the same height
  EXPECT_NEAR(table.at({0, 3.91, 0}), 0, 0.03);
}

TEST(DistanceTable, MatchesTheDistanceToEveryTriangle) {
  const CellType cell = testing::red_cell(3);
  const DistanceTable table(cell.shape, cell.triangles, 0.4);
  Random random(3);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{random.uniform(-4.2, 4.2), random.uniform(-4.2, 4.2), random.uniform(-1.6, 1.6)};
    double exact = 0.4;
    for (std::size_t t = 0; t < cell.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t c) {
        const auto v = 3 * static_cast<std::size_t>(cell.triangles[t + c]);
        return Vec3{cell.shape[v], cell.shape[v + 1], cell.shape[v + 2]};
      };
      exact = std::min(exact, distance_to_triangle(p, corner(0), corner(1), corner(2)));
    }
    EXPECT_NEAR(std::abs(table.at(p)), exact, 0.05);
  }
}

}  // namespace
}  // namespace npfem::flow
