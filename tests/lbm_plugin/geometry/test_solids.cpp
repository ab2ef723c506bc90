// SPDX-License-Identifier: MPL-2.0
// Obstacles, slits and constrictions as signed distances, and in a domain.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/domain.h"

namespace npfem::flow {
namespace {

Domain domain_of(DomainKind kind, std::vector<Solid> solids = {}) {
  Domain domain;
  domain.kind = kind;
  domain.nodes = {40, 40, 60};
  domain.dx = 0.5;
  domain.tube_radius = 10;
  domain.solids = std::move(solids);
  domain.share_of_fluid = measured_share_of_fluid(domain);
  return domain;
}

/// Moving from a point against the normal by the distance must end on the wall.
void expect_sound(const Domain& domain, const Vec3& at) {
  const WallDistance wall = domain.wall_distance(at);
  EXPECT_NEAR(norm(wall.normal), 1, 1e-12);
  const WallDistance foot = domain.wall_distance(subtract(at, scale(wall.distance, wall.normal)));
  EXPECT_NEAR(foot.distance, 0, 1e-6) << at[0] << " " << at[1] << " " << at[2];
}

TEST(BoxSolid, DistanceToFaceEdgeAndCorner) {
  const BoxSolid box{{1, 2, 3}, {1, 2, 3}};
  EXPECT_DOUBLE_EQ(box.distance({5, 2, 3}).distance, 3);
  EXPECT_EQ(box.distance({5, 2, 3}).normal, (Vec3{1, 0, 0}));
  EXPECT_DOUBLE_EQ(box.distance({5, 8, 3}).distance, 5);
  EXPECT_NEAR(box.distance({5, 8, 3}).normal[1], 0.8, 1e-15);
  EXPECT_DOUBLE_EQ(box.distance({-2, 2 - 4, 6 + 2}).distance, std::sqrt(4 + 4 + 4));
  EXPECT_DOUBLE_EQ(box.distance({1.75, 2, 3}).distance, -0.25);
  EXPECT_EQ(box.distance({1.75, 2, 3}).normal, (Vec3{1, 0, 0}));
}

TEST(SphereSolid, Distance) {
  const SphereSolid sphere{{1, 1, 1}, 2};
  EXPECT_DOUBLE_EQ(sphere.distance({1, 4, 5}).distance, 3);
  EXPECT_NEAR(sphere.distance({1, 4, 5}).normal[2], 0.8, 1e-15);
  EXPECT_DOUBLE_EQ(sphere.distance({1, 1, 1}).distance, -2);
}

TEST(Solids, TheNearestWallCountsAndPeriodicImagesDo) {
  const Domain domain = domain_of(DomainKind::plates, {BoxSolid{{1, 10, 15}, {2, 2, 2}}});
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 1, 15}).distance, 1) << "the plate";
  EXPECT_DOUBLE_EQ(domain.wall_distance({6, 10, 15}).distance, 3) << "the box";
  EXPECT_DOUBLE_EQ(domain.wall_distance({18, 10, 15}).distance, 1) << "the box's image beyond the periodic face";
  EXPECT_DOUBLE_EQ(domain.wall_distance({46, 10, 15 - 60}).distance, 3) << "two periods away";
  EXPECT_EQ(domain.node_kind({0, 20, 30}), 1);
  EXPECT_EQ(domain.node_kind({39, 20, 30}), 1) << "of the image";
  EXPECT_EQ(domain.node_kind({-1, 20, 30}), 1);
  EXPECT_EQ(domain.node_kind({10, 20, 30}), 0);
  EXPECT_TRUE(domain.has_walls());
  EXPECT_TRUE(domain_of(DomainKind::periodic_box, {SphereSolid{{5, 5, 5}, 1}}).has_walls());
  EXPECT_FALSE(domain_of(DomainKind::periodic_box).has_walls());
}

TEST(Solids, TakeTheirVolumeFromTheFluid) {
  const double box = 20.0 * 20.0 * 30.0;
  EXPECT_NEAR(domain_of(DomainKind::periodic_box, {BoxSolid{{10, 10, 15}, {2, 3, 4}}}).fluid_volume(), box - 192, 1);
  EXPECT_NEAR(domain_of(DomainKind::periodic_box, {SphereSolid{{10, 10, 15}, 6}}).fluid_volume(),
              box - 4.0 / 3 * std::numbers::pi * 216, 3);
  const double tube = std::numbers::pi * 100 * 30;
  EXPECT_NEAR(domain_of(DomainKind::tube, {BoxSolid{{10, 10, 15}, {2, 3, 4}}}).fluid_volume(), tube - 192, 2);
}

TEST(Slit, IsAWallWithARectangularOpening) {
  const Domain domain = domain_of(
      DomainKind::plates,
      {Slit({.along = 0, .across = 1, .centre = {10, 10, 15}, .length = 4, .width = 3, .depth = 8}, {20, 20, 30})});
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 10.5, 15}).distance, 1) << "inside the slit";
  EXPECT_EQ(domain.wall_distance({10, 10.5, 15}).normal, (Vec3{0, -1, 0}));
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 10, 18.5}).distance, 0.5) << "near its end";
  EXPECT_DOUBLE_EQ(domain.wall_distance({5, 2, 15}).distance, 2) << "before it: the plate";
  EXPECT_DOUBLE_EQ(domain.wall_distance({7, 4, 15}).distance, 1) << "before it: the wall";
  EXPECT_DOUBLE_EQ(domain.wall_distance({5, 10, 15}).distance, std::hypot(3, 1.5)) << "its edge";
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 4, 15}).distance, -2);
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 10, 29}).distance, -2) << "closed up to the periodic face";
  int open = 0;
  for (int j = 0; j < 40; ++j) {
    for (int k = 0; k < 60; ++k) open += domain.node_kind({20, j, k}) == 0 ? 1 : 0;
  }
  EXPECT_EQ(open, 6 * 16);
  EXPECT_NEAR(domain.fluid_volume(), 20 * 20 * 30 - 4 * (20 * 30 - 3 * 8), 0.01 * 2304);
  const Slit whole({.along = 0, .across = 1, .centre = {10, 10, 15}, .length = 4, .width = 3, .depth = {}},
                   {20, 20, 30});
  EXPECT_DOUBLE_EQ(whole.distance({10, 10, 0}).distance, 1.5);
}

TEST(Constriction, NarrowsByACosine) {
  const Constriction::Shape round{
      .along = 2, .round = true, .centre = {10, 10, 15}, .length = 16, .wide = 10, .narrow = 4};
  const Domain tube = domain_of(DomainKind::tube, {Constriction(round)});
  EXPECT_NEAR(tube.wall_distance({13, 10, 15}).distance, 1, 1e-9) << "in the throat the wall is parallel to the axis";
  EXPECT_NEAR(tube.wall_distance({19, 10, 1}).distance, 1, 1e-9) << "away from it the tube";
  const double quarter = 0.5 * (10 + 4);  // half-way down the flank the wall is there
  EXPECT_NEAR(tube.wall_distance({10 + quarter, 10, 11}).distance, 0, 1e-9);
  EXPECT_NEAR(tube.wall_distance({10, 10 - quarter, 19}).distance, 0, 1e-9);
  for (const Vec3& at :
       {Vec3{12, 11, 14}, Vec3{15, 12, 11}, Vec3{10, 16, 10}, Vec3{16.5, 10, 18.5}, Vec3{10, 13, 13}}) {
    expect_sound(tube, at);
  }
  const double volume = std::numbers::pi * (100 * 14 + 16 * (7 * 7 + 0.5 * 3 * 3));  // mean of h^2 over the wave
  EXPECT_NEAR(tube.fluid_volume(), volume, 2e-3 * volume);

  const Domain plates = domain_of(
      DomainKind::plates,
      {Constriction({.along = 0, .round = false, .centre = {10, 10, 15}, .length = 20, .wide = 10, .narrow = 2})});
  EXPECT_NEAR(plates.wall_distance({10, 11, 3}).distance, 1, 1e-9);
  EXPECT_EQ(plates.wall_distance({10, 11, 3}).normal, (Vec3{0, -1, 0}));
  EXPECT_NEAR(plates.fluid_volume(), 20 * 30 * 2 * 6, 10);
}

TEST(Constriction, DistanceIsThatOfADenseSearchNearTheWallAndLessElsewhere) {
  const Constriction::Shape shape{
      .along = 2, .round = true, .centre = {0, 0, 0}, .length = 12, .wide = 10, .narrow = 3};
  const Constriction wall(shape);
  for (double s = -9; s <= 9; s += 0.37) {
    for (double h = 0; h < 12; h += 0.41) {
      double exact = 1e9;
      for (double t = s - 7; t <= s + 7; t += 2e-3) {
        const double bump = std::abs(t) < 6 ? 0.5 * (1 + std::cos(2 * std::numbers::pi * t / 12)) : 0;
        exact = std::min(exact, std::hypot(t - s, 10 - 7 * bump - h));
      }
      const double found = wall.distance({h, 0, s}).distance;
      EXPECT_LE(std::abs(found), exact + 1e-5) << s << " " << h;
      if (std::abs(found) < 1) {
        EXPECT_NEAR(found * found, exact * exact, 1e-5) << s << " " << h;
      }
    }
  }
}

}  // namespace
}  // namespace npfem::flow
