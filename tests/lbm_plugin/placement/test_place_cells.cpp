// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "cell_shapes.h"
#include "geometry/cell_shape.h"
#include "placement/place_cells.h"
#include "placement/triangle_distance.h"

namespace npfem::flow {
namespace {

Domain tube(double radius, double length) {
  Domain domain;
  domain.kind = DomainKind::tube;
  domain.dx = 0.5;
  const int across = static_cast<int>(std::lround(2 * radius / domain.dx));
  domain.nodes = {across, across, static_cast<int>(std::lround(length / domain.dx))};
  domain.tube_radius = radius;
  return domain;
}

Domain box(DomainKind kind, double x, double y, double z) {
  Domain domain;
  domain.kind = kind;
  domain.dx = 0.5;
  domain.nodes = {static_cast<int>(std::lround(x / 0.5)), static_cast<int>(std::lround(y / 0.5)),
                  static_cast<int>(std::lround(z / 0.5))};
  return domain;
}

struct Surface {
  std::vector<Vec3> vertices;
  std::span<const std::int32_t> triangles;
  Vec3 centre;
};

Surface surface_of(const CellStart& start, std::span<const CellType> types) {
  const CellType& type = types[static_cast<std::size_t>(start.type)];
  Surface surface{{}, type.triangles, start.centre};
  for (std::size_t v = 0; v < type.shape.size(); v += 3) {
    const Vec3 local{type.shape[v], type.shape[v + 1], type.shape[v + 2]};
    surface.vertices.push_back(add(start.centre, rotate(start.rotation, local)));
  }
  return surface;
}

double vertex_triangle_gap(const Surface& a, const Surface& b, const Vec3& shift) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : a.vertices) {
    const Vec3 p = add(vertex, shift);
    for (std::size_t t = 0; t < b.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t c) { return b.vertices[static_cast<std::size_t>(b.triangles[t + c])]; };
      gap = std::min(gap, distance_to_triangle(p, corner(0), corner(1), corner(2)));
    }
  }
  return gap;
}

/// Winding number of the surface around p by solid angles (van Oosterom & Strackee 1983): 1 inside, 0 outside.
double winding(const Surface& s, const Vec3& p) {
  double angle = 0;
  for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t c) {
      return subtract(s.vertices[static_cast<std::size_t>(s.triangles[t + c])], p);
    };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * M_PI);
}

/// Smallest gap between any two cells, by vertex-triangle distances and winding numbers, over all periodic images.
double least_gap(const Domain& domain, std::span<const CellType> types, const std::vector<CellStart>& cells) {
  std::vector<Surface> surfaces;
  for (const CellStart& cell : cells) surfaces.push_back(surface_of(cell, types));
  const auto periodic = domain.periodic();
  const Vec3 size = domain.size();
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < surfaces.size(); ++a) {
    for (std::size_t b = 0; b < surfaces.size(); ++b) {
      for (int i = -periodic[0]; i <= int{periodic[0]}; ++i) {
        for (int j = -periodic[1]; j <= int{periodic[1]}; ++j) {
          for (int k = -periodic[2]; k <= int{periodic[2]}; ++k) {
            if (a == b && i == 0 && j == 0 && k == 0) continue;
            const Vec3 shift{i * size[0], j * size[1], k * size[2]};
            if (norm(subtract(add(surfaces[a].centre, shift), surfaces[b].centre)) > 9) continue;
            gap = std::min(gap, vertex_triangle_gap(surfaces[a], surfaces[b], shift));
            if (winding(surfaces[b], add(surfaces[a].vertices[0], shift)) > 0.5) return -1;
          }
        }
      }
    }
  }
  return gap;
}

double least_wall_gap(const Domain& domain, std::span<const CellType> types, const std::vector<CellStart>& cells) {
  double gap = std::numeric_limits<double>::infinity();
  for (const CellStart& cell : cells) {
    for (const Vec3& v : surface_of(cell, types).vertices) gap = std::min(gap, domain.wall_distance(v).distance);
  }
  return gap;
}

int count_for(const Domain& domain, const CellType& type, double haematocrit) {
  return static_cast<int>(
      std::lround(haematocrit * domain.fluid_volume() / enclosed_volume(type.shape, type.triangles)));
}

// the distance table is trilinear on a grid of 0.1 um: it may err by a few per cent of the spacing at sharp edges
constexpr double table_error = 0.03;

TEST(PlaceCells, BloodInATubeKeepsItsGap) {
  const Domain domain = tube(10, 30);
  const std::vector<CellType> types{testing::red_cell(), testing::platelet()};
  const PlacementRequest request{{count_for(domain, types[0], 0.20), 8}, {}, 0.3, 1};
  ASSERT_EQ(request.counts[0], 21);
  const Placement placed = place_cells(domain, types, request);
  ASSERT_EQ(placed.cells.size(), 29u);
  for (std::size_t n = 0; n < 29; ++n) EXPECT_EQ(placed.cells[n].type, n < 21 ? 0 : 1);
  EXPECT_GE(least_gap(domain, types, placed.cells), 0.3 - table_error);
  EXPECT_GE(least_wall_gap(domain, types, placed.cells), 0.3);
}

TEST(PlaceCells, GrowsWherePlacementJams) {
  const Domain domain = tube(10, 20);
  const std::vector<CellType> types{testing::red_cell()};
  const PlacementRequest request{{count_for(domain, types[0], 0.30)}, {}, 0.3, 4};
  const Placement placed = place_cells(domain, types, request);
  EXPECT_TRUE(placed.grown);
  EXPECT_GE(least_gap(domain, types, placed.cells), 0.3 - table_error);
  EXPECT_GE(least_wall_gap(domain, types, placed.cells), 0.3);
}

TEST(PlaceCells, PeriodicBoxCountsEveryImage) {
  const Domain domain = box(DomainKind::periodic_box, 10, 10, 10);
  const std::vector<CellType> types{testing::red_cell()};
  const Placement placed = place_cells(domain, types, {{2}, {}, 0.2, 7});
  EXPECT_GE(least_gap(domain, types, placed.cells), 0.2 - table_error);
}

TEST(PlaceCells, SameSeedSamePlacesOtherSeedOthers) {
  const Domain domain = box(DomainKind::plates, 20, 20, 20);
  const std::vector<CellType> types{testing::red_cell(), testing::platelet()};
  const auto place = [&](std::uint64_t seed) { return place_cells(domain, types, {{9, 3}, {}, 0.2, seed}).cells; };
  const auto first = place(11), again = place(11), other = place(12);
  for (std::size_t n = 0; n < first.size(); ++n) {
    EXPECT_EQ(first[n].centre, again[n].centre);
    EXPECT_EQ(first[n].rotation, again[n].rotation);
    EXPECT_NE(first[n].centre, other[n].centre);
  }
}

TEST(PlaceCells, RandomCellsKeepClearOfGivenOnes) {
  const Domain domain = box(DomainKind::periodic_box, 14, 14, 14);
  const std::vector<CellType> types{testing::red_cell()};
  const CellStart given{0, {7, 7, 7}, identity_rotation};
  const Placement placed = place_cells(domain, types, {{4}, {given}, 0.2, 1});
  ASSERT_EQ(placed.cells.size(), 5u);
  EXPECT_EQ(placed.cells[0].centre, given.centre);
  EXPECT_GE(least_gap(domain, types, placed.cells), 0.2 - table_error);
}

std::string error_of(const Domain& domain, std::span<const CellType> types, const PlacementRequest& request) {
  try {
    place_cells(domain, types, request);
  } catch (const PlacementError& error) {
    return error.what();
  }
  return "no error";
}

TEST(PlaceCells, GivenCellsMustBeInsideAndApart) {
  const std::vector<CellType> types{testing::red_cell()};
  const Domain between = box(DomainKind::plates, 20, 20, 20);
  EXPECT_EQ(error_of(between, types, {{0}, {{0, {10, 1, 10}, rotation_about({0, 0, 1}, 0)}}, 0.2, 1}),
            "cell 0 (rbc) at (10, 1, 10) um is outside the walls or across one; move it, or take it out of the list");
  EXPECT_EQ(error_of(between, types, {{0}, {{0, {10, 40, 10}, identity_rotation}}, 0.2, 1}),
            "cell 0 (rbc) at (10, 40, 10) um is outside the walls or across one; move it, or take it out of the list");
  EXPECT_EQ(error_of(between, types,
                     {{0}, {{0, {10, 8, 10}, identity_rotation}, {0, {14, 8, 10}, identity_rotation}}, 0.2, 1}),
            "cell 1 (rbc) at (14, 8, 10) um is overlapping cell 0 (rbc); move it, or take it out of the list");
  // across the periodic face
  EXPECT_EQ(error_of(between, types,
                     {{0}, {{0, {1, 8, 10}, identity_rotation}, {0, {19, 8, 10}, identity_rotation}}, 0.2, 1}),
            "cell 1 (rbc) at (19, 8, 10) um is overlapping cell 0 (rbc); move it, or take it out of the list");
  EXPECT_EQ(
      error_of(box(DomainKind::periodic_box, 7, 20, 20), types, {{0}, {{0, {1, 8, 10}, identity_rotation}}, 0.2, 1}),
      "cell 0 (rbc) at (1, 8, 10) um is overlapping its own periodic image: the box is too small for it; move it, "
      "or take it out of the list");
}

/// A small cell inside a large one: only the vertices of the small one are inside the other, whichever comes first.
TEST(PlaceCells, NoCellHidesInsideAnother) {
  const std::vector<CellType> types{testing::red_cell(), testing::sphere(0.2, 1)};
  const Domain between = box(DomainKind::plates, 20, 20, 20);
  const CellStart large{0, {10, 10, 10}, identity_rotation};
  const CellStart small{1, {12.8, 10, 10}, identity_rotation};
  EXPECT_EQ(error_of(between, types, {{0, 0}, {large, small}, 0.2, 1}),
            "cell 1 (sphere) at (12.8, 10, 10) um is overlapping cell 0 (rbc); move it, or take it out of the list");
  EXPECT_EQ(error_of(between, types, {{0, 0}, {small, large}, 0.2, 1}),
            "cell 1 (rbc) at (10, 10, 10) um is overlapping cell 0 (sphere); move it, or take it out of the list");
}

TEST(PlaceCells, SaysWhatItReachedWhereThereIsNoRoom) {
  const std::vector<CellType> types{testing::sphere(2.0)};
  const std::string message = error_of(box(DomainKind::periodic_box, 10, 10, 10), types, {{23}, {}, 0.2, 1});
  EXPECT_EQ(message.substr(0, 82), "no room for 23 cells (haematocrit 0.753): random placement stopped at haematocrit ")
      << message;
  EXPECT_NE(message.find("lower the haematocrit or placement.gap (now 0.2 um), take a larger domain, or pack"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace npfem::flow
