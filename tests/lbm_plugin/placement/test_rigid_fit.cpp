// SPDX-License-Identifier: MPL-2.0
#include "placement/rigid_fit.h"

#include <gtest/gtest.h>

#include <vector>

namespace npfem::flow {
namespace {

const std::vector<double> brick{-1, -2, -3, 1, -2, -3, -1, 2, -3, 1, 2, -3, -1, -2, 3, 1, -2, 3, -1, 2, 3, 1, 2, 3};

std::vector<double> placed(const Rotation& rotation, const Vec3& at, double stretch) {
  std::vector<double> xyz;
  for (std::size_t v = 0; v < brick.size(); v += 3) {
    const Vec3 x = add(at, rotate(rotation, {stretch * brick[v], brick[v + 1] / stretch, brick[v + 2]}));
    xyz.insert(xyz.end(), x.begin(), x.end());
  }
  return xyz;
}

TEST(RigidFit, FindsHowABodyIsTurned) {
  for (const Vec3& angles : {Vec3{0, 0, 0}, Vec3{0.3, -1.2, 2.5}, Vec3{3.1, 0, 0}, Vec3{-2, 1.5, 0.7}}) {
    const Rotation rotation = rotation_about_xyz(angles);
    const std::vector<double> xyz = placed(rotation, {5, -7, 11}, 1.4);
    const Rotation found = rotation_between(brick, xyz);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(found[i], rotation[i], 1e-12);
    const Vec3 middle = middle_of(xyz);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(middle[a], Vec3({5, -7, 11})[a], 1e-13);
  }
}

TEST(RigidFit, LeavesAFlatBodyUnturned) {
  std::vector<double> flat = brick;
  for (std::size_t i = 2; i < flat.size(); i += 3) flat[i] = 0;
  EXPECT_EQ(rotation_between(brick, flat), identity_rotation);
}

}  // namespace
}  // namespace npfem::flow
