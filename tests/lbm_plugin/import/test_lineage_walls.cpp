// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_walls.h"

#include <gtest/gtest.h>

#include "stl_surfaces.h"

namespace npfem::flow {
namespace {

std::optional<LineageWall> wall_of(const std::vector<stl::Triangle>& triangles) {
  return recognised(parse_stl(stl::binary(triangles), "test"));
}

TEST(LineageWalls, TwoPlanesAcrossY) {
  const std::vector<stl::Triangle> planes{{{{0, 1, 0}, {50, 1, 0}, {0, 1, 50}}},
                                          {{{50, 1, 0}, {50, 1, 50}, {0, 1, 50}}},
                                          {{{0, 49, 0}, {50, 49, 0}, {0, 49, 50}}}};
  const auto wall = wall_of(planes);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->kind, LineageWall::Kind::planes);
  EXPECT_EQ(wall->low, 1);
  EXPECT_EQ(wall->high, 49);
}

TEST(LineageWalls, TubeAlongZ) {
  const auto wall = wall_of(stl::mantle({26, 26, 0}, 25, 50, 96, 20));
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->kind, LineageWall::Kind::tube);
  EXPECT_NEAR(wall->radius, 25, 1e-5);
  EXPECT_NEAR(wall->middle[0], 26, 1e-5);
  EXPECT_NEAR(wall->middle[1], 26, 1e-5);
}

TEST(LineageWalls, BoxAndOtherBodies) {
  const auto box = wall_of(stl::box({7.5, 7.5, 17.5}, {12.5, 12.5, 22.5}));
  ASSERT_TRUE(box);
  EXPECT_EQ(box->kind, LineageWall::Kind::box);
  EXPECT_EQ(box->middle, (Vec3{10, 10, 20}));
  EXPECT_EQ(box->size, (Vec3{5, 5, 5}));
  const auto ball = wall_of(stl::sphere({10, 10, 10}, 4, 24));
  ASSERT_TRUE(ball);
  EXPECT_EQ(ball->kind, LineageWall::Kind::body);
}

TEST(LineageWalls, AnythingElseIsNone) {
  auto bowl = stl::sphere({10, 10, 10}, 4, 24);
  std::erase_if(bowl, [](const stl::Triangle& t) { return t[0][2] > 11; });
  EXPECT_FALSE(wall_of(bowl));
}

}  // namespace
}  // namespace npfem::flow
