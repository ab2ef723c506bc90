// SPDX-License-Identifier: MPL-2.0
#include "output/principal_stretches.h"

#include <gtest/gtest.h>

#include "cell_shapes.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

const std::vector<std::int32_t> triangle{0, 1, 2};
const std::vector<double> flat{0.1, 0.2, 0, 1.4, -0.3, 0, 0.5, 1.1, 0};

/// Stretched by 1.5 and 0.8 along two perpendicular directions of its plane, turned and moved.
std::vector<double> stretched() {
  const Rotation in_plane = rotation_about({0, 0, 1}, 0.7), in_space = rotation_about_xyz({0.3, -1.1, 2.0});
  std::vector<double> xyz;
  for (std::size_t v = 0; v < 9; v += 3) {
    const Vec3 turned = rotate(in_plane, {flat[v], flat[v + 1], flat[v + 2]});
    const Vec3 placed = add(rotate(in_space, {1.5 * turned[0], 0.8 * turned[1], 0}), {5, 6, 7});
    xyz.insert(xyz.end(), placed.begin(), placed.end());
  }
  return xyz;
}

TEST(PrincipalStretches, AreThoseOfTheMap) {
  const auto found = principal_stretches(flat, stretched(), triangle);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].larger, 1.5, 1e-14);
  EXPECT_NEAR(found[0].smaller, 0.8, 1e-14);
  EXPECT_EQ(largest_stretch(found), found[0].larger);
  EXPECT_EQ(largest_stretch({}), 1);
}

TEST(PrincipalStretches, AreOneAtRestAndEqualForAnInflatedCell) {
  const CellType cell = testing::red_cell(2);
  std::vector<double> inflated = cell.shape;
  for (double& x : inflated) x *= 1.2;
  for (const auto& stretch : principal_stretches(cell.shape, cell.shape, cell.triangles)) {
    EXPECT_NEAR(stretch.larger, 1, 1e-7);  // the root of a difference that is zero
    EXPECT_NEAR(stretch.smaller, 1, 1e-7);
  }
  for (const auto& stretch : principal_stretches(cell.shape, inflated, cell.triangles)) {
    EXPECT_NEAR(stretch.larger, 1.2, 1e-7);
    EXPECT_NEAR(stretch.smaller, 1.2, 1e-7);
  }
}

TEST(PrincipalStretches, OfATriangleThatHasCollapsed) {
  const std::vector<double> line{0, 0, 0, 2, 0, 0, 1, 0, 0};
  const auto found = principal_stretches(flat, line, triangle);
  EXPECT_GT(found[0].larger, 0);
  EXPECT_EQ(found[0].smaller, 0);
}

}  // namespace
}  // namespace npfem::flow
