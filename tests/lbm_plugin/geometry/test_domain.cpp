// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/domain.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

Domain domain_of(DomainKind kind) {
  Domain domain;
  domain.kind = kind;
  domain.nodes = {40, 40, 60};
  domain.dx = 0.5;
  domain.tube_radius = 10;
  domain.plate_speed = 2;
  return domain;
}

TEST(Domain, PeriodicBoxHasNoWalls) {
  const Domain box = domain_of(DomainKind::periodic_box);
  EXPECT_EQ(box.periodic(), (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(box.node_kind({0, 0, 0}), 0);
  EXPECT_EQ(box.wall_distance({1, 2, 3}).distance, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(box.fluid_volume(), 20.0 * 20.0 * 30.0);
}

TEST(Domain, ShearBoxHasPlatesThatMoveApart) {
  const Domain box = domain_of(DomainKind::shear_box);
  EXPECT_EQ(box.periodic(), (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(box.node_kind({3, -1, 5}), 2);
  EXPECT_EQ(box.node_kind({3, 40, 5}), 3);
  EXPECT_EQ(box.node_kind({3, 0, 5}), 0);
  EXPECT_EQ(box.wall_velocity(2), (Vec3{-1, 0, 0}));
  EXPECT_EQ(box.wall_velocity(3), (Vec3{1, 0, 0}));
}

TEST(Domain, PlatesAtRest) {
  const Domain box = domain_of(DomainKind::plates);
  EXPECT_EQ(box.node_kind({0, -1, 0}), 1);
  EXPECT_EQ(box.node_kind({0, 40, 0}), 1);
  EXPECT_EQ(box.wall_velocity(1), (Vec3{0, 0, 0}));
  const WallDistance low = box.wall_distance({3, 2, 4});
  EXPECT_DOUBLE_EQ(low.distance, 2);
  EXPECT_EQ(low.normal, (Vec3{0, 1, 0}));
  const WallDistance high = box.wall_distance({3, 19, 4});
  EXPECT_DOUBLE_EQ(high.distance, 1);
  EXPECT_EQ(high.normal, (Vec3{0, -1, 0}));
  EXPECT_LT(box.wall_distance({3, -0.5, 4}).distance, 0);
  EXPECT_LT(box.wall_distance({3, 20.5, 4}).distance, 0);
}

TEST(Domain, TubeNodesFillTheCircle) {
  const Domain tube = domain_of(DomainKind::tube);
  int fluid = 0;
  for (int i = -1; i <= 40; ++i) {
    for (int j = -1; j <= 40; ++j) {
      const double x = (i + 0.5) * 0.5 - 10;
      const double y = (j + 0.5) * 0.5 - 10;
      const bool inside = x * x + y * y < 100;
      EXPECT_EQ(tube.node_kind({i, j, 7}), inside ? 0 : 1);
      fluid += inside ? 1 : 0;
    }
  }
  EXPECT_NEAR(fluid * 0.25, std::numbers::pi * 100, 2);
  EXPECT_DOUBLE_EQ(tube.fluid_volume(), std::numbers::pi * 100 * 30);
}

TEST(Domain, WallNormalIsTheGradientOfTheDistance) {
  for (const DomainKind kind : {DomainKind::plates, DomainKind::shear_box, DomainKind::tube}) {
    const Domain domain = domain_of(kind);
    const Vec3 at{13.1, 6.2, 4.0};
    const WallDistance wall = domain.wall_distance(at);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 beside = at;
      beside[axis] += 1e-6;
      EXPECT_NEAR((domain.wall_distance(beside).distance - wall.distance) / 1e-6, wall.normal[axis], 1e-5);
    }
  }
  const WallDistance axis = domain_of(DomainKind::tube).wall_distance({10, 10, 3});
  EXPECT_DOUBLE_EQ(axis.distance, 10);
  EXPECT_DOUBLE_EQ(norm(axis.normal), 1);
}

TEST(Rotations, AreProperAndInverseOfTheirTranspose) {
  const Rotation r = rotation_about_xyz({0.3, -1.1, 2.0});
  const Vec3 a{1, 2, 3};
  const Vec3 there_and_back = rotate_back(r, rotate(r, a));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(there_and_back[i], a[i], 1e-14);
  const Vec3 turned = rotate(rotation_about({0, 0, 1}, std::numbers::pi / 2), {1, 0, 0});
  EXPECT_NEAR(turned[1], 1, 1e-15);
  // about x first: z goes to -y, which the turn about z takes to x
  const double right = std::numbers::pi / 2;
  const Vec3 both = rotate(rotation_about_xyz({right, 0, right}), {0, 0, 1});
  EXPECT_NEAR(both[0], 1, 1e-15);
}

}  // namespace
}  // namespace npfem::flow
