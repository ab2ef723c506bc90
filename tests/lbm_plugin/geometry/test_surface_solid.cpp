// SPDX-License-Identifier: MPL-2.0
// Walls from STL files: reading, checking, voxels and distances.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "geometry/domain.h"
#include "geometry/surface_check.h"
#include "quantity.h"
#include "stl_surfaces.h"

namespace npfem::flow {
namespace {

const SurroundingBox closed_box{{20, 20, 20}, {}, 1e-3};
const SurroundingBox open_along_z{{20, 20, 20}, {false, false, false, false, true, true}, 1e-3};

TriangleSurface surface_of(const std::vector<stl::Triangle>& triangles) {
  return parse_stl(stl::text(triangles), "test.stl");
}

std::string error_of(const std::string& bytes) {
  try {
    parse_stl(bytes, "test.stl");
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Stl, TextAndBinaryGiveTheSameSurface) {
  const auto box = stl::box({1, 2, 3}, {4, 6, 8});
  const TriangleSurface from_text = parse_stl(stl::text(box), "t");
  const TriangleSurface from_binary = parse_stl(stl::binary(box), "b");
  EXPECT_EQ(from_text.vertices.size(), 8u);
  EXPECT_EQ(from_text.triangles.size(), 12u);
  EXPECT_EQ(from_binary.vertices, from_text.vertices);
  EXPECT_EQ(from_binary.triangles, from_text.triangles);
  EXPECT_NEAR(volume_inside(from_text, closed_box), 3 * 4 * 5, 1e-12);
}

TEST(Stl, NearlyEqualVerticesBecomeOne) {
  auto box = stl::box({0, 0, 0}, {10, 10, 10});
  box[0][0][0] += 2e-6;
  EXPECT_EQ(surface_of(box).vertices.size(), 8u);
  box[0][0][0] += 1e-3;
  EXPECT_EQ(surface_of(box).vertices.size(), 9u);
}

TEST(Stl, WhatIsNotStlIsRefused) {
  const std::string bytes = stl::binary(stl::box({0, 0, 0}, {1, 1, 1}));
  const std::string text = stl::text(stl::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(error_of("PK" + bytes.substr(2, bytes.size() - 3)),
            "\"test.stl\" is not an STL file: it neither begins with \"solid\" nor has the length that its number of "
            "triangles needs; it may be cut short");
  EXPECT_EQ(error_of(""), error_of("x"));
  EXPECT_EQ(error_of("solid a\nendsolid\n"), "\"test.stl\" has no triangle");
  EXPECT_EQ(error_of("solid a\n facet\n vertex 1 2 x\n"), "\"test.stl\" line 3: found \"x\" where a number is needed");
  EXPECT_EQ(error_of("solid a\n facet\n vertex 1 2 3\n vertex 1 2 3\n endfacet"),
            "\"test.stl\" line 5: found a facet without three vertices");
  EXPECT_EQ(error_of(text.substr(0, text.find("vertex", 100) + 20)).substr(0, 11), "\"test.stl\" ");
  std::string not_finite = bytes;
  for (std::size_t n = 0; n < 4; ++n) not_finite[84 + 12 + n] = static_cast<char>(0xff);
  EXPECT_EQ(error_of(not_finite), "\"test.stl\" has a coordinate that is not a finite number, in triangle 0");
}

TEST(SurfaceCheck, SoundSurfacesPass) {
  EXPECT_EQ(fault_of(surface_of(stl::box({1, 1, 1}, {9, 9, 9})), closed_box), "");
  EXPECT_EQ(fault_of(surface_of(stl::sphere({10, 10, 10}, 6, 24)), closed_box), "");
  EXPECT_EQ(fault_of(surface_of(stl::mantle({10, 10, 0}, 5, 20, 24, 10)), open_along_z), "");
  auto nested = stl::box({1, 1, 1}, {9, 9, 9});
  for (const auto& t : stl::box({3, 3, 3}, {5, 5, 5})) nested.push_back({t[0], t[2], t[1]});
  EXPECT_EQ(fault_of(surface_of(nested), closed_box), "");
  EXPECT_NEAR(volume_inside(surface_of(nested), closed_box), 512 - 8, 1e-9);
}

TEST(SurfaceCheck, FaultsAreNamedWithTheirPlace) {
  auto hole = stl::box({1, 2, 3}, {9, 9, 9});
  hole.pop_back();
  EXPECT_EQ(fault_of(surface_of(hole), closed_box), "has a hole at the edge from (1, 2, 9) um to (1, 9, 9) um");
  auto inverted = stl::box({1, 2, 3}, {9, 9, 9});
  std::swap(inverted[3][1], inverted[3][2]);
  EXPECT_NE(fault_of(surface_of(inverted), closed_box).find("has two triangles of opposite orientation at the edge "),
            std::string::npos);
  auto twice = stl::box({1, 2, 3}, {9, 9, 9});
  twice.push_back(twice[5]);
  EXPECT_NE(fault_of(surface_of(twice), closed_box).find("has more than two triangles at the edge from ("),
            std::string::npos);
  auto crossing = stl::box({1, 1, 1}, {9, 9, 9});
  for (const auto& t : stl::box({5, 5, 5}, {12, 12, 12})) crossing.push_back(t);
  EXPECT_EQ(fault_of(surface_of(crossing), closed_box).find("cuts itself: the triangles around ("), 0u);
  EXPECT_EQ(fault_of(surface_of(stl::box({1, 1, 1}, {9, 21, 9})), closed_box),
            "reaches out of the box at (1, 21, 9) um; the box goes from (0, 0, 0) to (20, 20, 20) um");
  EXPECT_NE(fault_of(surface_of(stl::mantle({10, 10, 0}, 5, 20, 24, 10)), closed_box).find("has a hole"),
            std::string::npos)
      << "an end is open only where the face of the box is";
  EXPECT_NE(fault_of(surface_of(stl::mantle({10, 10, 0}, 5, 19, 24, 10)), open_along_z).find("has a hole"),
            std::string::npos);
}

TEST(SurfaceCheck, AFoldedSphereCutsItself) {
  auto sphere = stl::sphere({10, 10, 10}, 6, 24);
  for (auto& t : sphere) {
    for (auto& p : t) {
      if (p[2] > 15) p[2] -= 14;  // the top pushed through the bottom
    }
  }
  EXPECT_EQ(fault_of(surface_of(sphere), closed_box).find("cuts itself"), 0u);
}

TEST(SurfaceCheck, OpenEndsAreClosedByTheBox) {
  const TriangleSurface tube = surface_of(stl::mantle({10, 10, 0}, 5, 20, 64, 10));
  const double polygon = 0.5 * 64 * 25 * std::sin(2 * std::numbers::pi / 64);
  EXPECT_NEAR(volume_inside(tube, open_along_z), polygon * 20, 1e-4);
  TriangleSurface turned = tube;
  turn_over(turned);
  EXPECT_NEAR(volume_inside(turned, open_along_z), -polygon * 20, 1e-4);
  TriangleSurface box = surface_of(stl::box({5, 5, 0}, {15, 15, 20}));
  drop_lids(box, open_along_z);
  EXPECT_EQ(box.triangles.size(), 8u);
  EXPECT_EQ(fault_of(box, open_along_z), "");
  EXPECT_NEAR(volume_inside(box, open_along_z), 2000, 1e-9);
}

Domain vessel(const TriangleSurface& surface, std::array<bool, 3> periodic, bool fluid_inside = true) {
  Domain domain;
  domain.kind = fluid_inside ? DomainKind::vessel : DomainKind::periodic_box;
  domain.nodes = {40, 40, 40};
  domain.dx = 0.5;
  domain.vessel_periodic = periodic;
  domain.solids.emplace_back(SurfaceSolid(surface, {domain.nodes, domain.dx, periodic}, fluid_inside));
  domain.share_of_fluid = measured_share_of_fluid(domain);
  return domain;
}

TEST(SurfaceSolid, SphereAsVesselAndAsObstacle) {
  const TriangleSurface sphere = surface_of(stl::sphere({10, 10, 10}, 8, 96));
  const Domain inside = vessel(sphere, {false, false, false});
  const Domain outside = vessel(sphere, {true, true, true}, false);
  int wrong = 0;
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      for (int k = 0; k < 40; ++k) {
        const Vec3 at{0.5 * i + 0.25, 0.5 * j + 0.25, 0.5 * k + 0.25};
        const double exact = 8 - norm(subtract(at, {10, 10, 10}));
        if (std::abs(exact) < 0.02) continue;  // the surface has facets
        wrong += (inside.node_kind({i, j, k}) == 0) != (exact > 0) ? 1 : 0;
        wrong += (outside.node_kind({i, j, k}) == 0) != (exact < 0) ? 1 : 0;
        const Vec3 beside = add(at, {0.21, 0.13, -0.08});
        const double true_distance = 8 - norm(subtract(beside, {10, 10, 10}));
        if (std::abs(true_distance) < 1) {
          worst = std::max(worst, std::abs(inside.wall_distance(beside).distance - true_distance));
        }
        if (true_distance > 0) {
          EXPECT_LE(inside.wall_distance(beside).distance, true_distance + 0.02);
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(worst, 0.02) << "um, of 0.5 um node spacing";
  const double volume = 4.0 / 3 * std::numbers::pi * 512;
  EXPECT_NEAR(inside.fluid_volume(), volume, 5e-3 * volume);
  EXPECT_NEAR(outside.fluid_volume(), 8000 - volume, 5e-3 * volume);
  const WallDistance wall = inside.wall_distance({10, 17.5, 10});
  EXPECT_NEAR(wall.normal[1], -1, 0.01);
}

TEST(SurfaceSolid, CornersOfABoxHaveTheRightSides) {
  const Domain domain = vessel(surface_of(stl::box({2.1, 3.1, 4.1}, {12.1, 13.1, 14.1})), {false, false, false});
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      for (int k = 0; k < 40; ++k) {
        const auto within = [](int n, double low) { return 0.5 * n + 0.25 > low && 0.5 * n + 0.25 < low + 10; };
        ASSERT_EQ(domain.node_kind({i, j, k}) == 0, within(i, 2.1) && within(j, 3.1) && within(k, 4.1));
      }
    }
  }
}

TEST(SurfaceSolid, TubeGoesOnAcrossThePeriodicFace) {
  const Domain domain = vessel(surface_of(stl::mantle({10, 10, 0}, 8, 20, 96, 20)), {false, false, true});
  EXPECT_EQ(domain.node_kind({20, 20, 0}), 0);
  EXPECT_EQ(domain.node_kind({20, 20, -1}), 0);
  EXPECT_EQ(domain.node_kind({2, 20, 0}), 1);
  for (const double z : {0.0, 0.1, 10.0, 19.99, 25.0}) {
    EXPECT_NEAR(domain.wall_distance({17.4, 10, z}).distance, 0.6, 0.01) << z;
    EXPECT_NEAR(domain.wall_distance({17.4, 10, z}).normal[2], 0, 1e-3) << z;
  }
  EXPECT_NEAR(domain.fluid_volume(), std::numbers::pi * 64 * 20, 20);
}

}  // namespace
}  // namespace npfem::flow
