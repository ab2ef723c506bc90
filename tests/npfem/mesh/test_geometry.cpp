// SPDX-License-Identifier: MPL-2.0
#include "mesh/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "mesh/generate.h"
#include "mesh/point_math.h"

namespace npfem {
namespace {

constexpr double pi = std::numbers::pi;

/// A box of the given size with a corner at `corner`.
TriangleMesh box(const Point& corner, const Point& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        {corner[0] + (i & 1 ? size[0] : 0), corner[1] + (i & 2 ? size[1] : 0), corner[2] + (i & 4 ? size[2] : 0)});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Turned about the unit vector `axis` (Rodrigues), then shifted.
TriangleMesh moved(TriangleMesh mesh, const Point& axis, double angle, const Point& shift) {
  for (Point& p : mesh.positions) {
    const Point along = scaled(dot(axis, p) * (1 - std::cos(angle)), axis);
    p = sum(shift, sum(scaled(std::cos(angle), p), sum(scaled(std::sin(angle), cross(axis, p)), along)));
  }
  return mesh;
}

TEST(Geometry, OfABoxIsExact) {
  const TriangleMesh mesh = box({5, -3, 2}, {1, 2, 4});
  EXPECT_DOUBLE_EQ(surface_area(mesh), 28);
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 8);
  EXPECT_DOUBLE_EQ(triangle_area(mesh, 0), 1);
  EXPECT_DOUBLE_EQ(reduced_volume(mesh), 6 * std::sqrt(pi) * 8 / std::pow(28, 1.5));
  const Point centre = volume_centroid(mesh), mean = mean_position(mesh);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(centre[i], (Point{5.5, -2, 4})[i], 1e-14);
    EXPECT_NEAR(mean[i], (Point{5.5, -2, 4})[i], 1e-14);
    EXPECT_DOUBLE_EQ(extents(mesh)[i], (Point{1, 2, 4})[i]);
  }
  const std::vector<double> areas = vertex_areas(mesh);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 28, 1e-13);
  EXPECT_DOUBLE_EQ(edge_lengths(mesh).min, 1);
  EXPECT_DOUBLE_EQ(edge_lengths(mesh).max, std::sqrt(20));
}

TEST(Geometry, PrincipalAxesOfABox) {
  // Second moments V s^2/12 along a side s.
  const PrincipalAxes axes = principal_axes(moved(box({5, -3, 2}, {1, 2, 4}), {0, 0, 1}, 0.3, {10, 20, 30}));
  EXPECT_NEAR(axes.second_moment[0], 8.0 / 12 * 1, 1e-11);
  EXPECT_NEAR(axes.second_moment[1], 8.0 / 12 * 4, 1e-11);
  EXPECT_NEAR(axes.second_moment[2], 8.0 / 12 * 16, 1e-11);
  EXPECT_NEAR(std::abs(dot(axes.axis[0], {std::cos(0.3), std::sin(0.3), 0})), 1, 1e-12);
  EXPECT_NEAR(std::abs(axes.axis[2][2]), 1, 1e-12);
  EXPECT_NEAR(dot(cross(axes.axis[0], axes.axis[1]), axes.axis[2]), 1, 1e-12);
}

TEST(Geometry, IsInvariantUnderRigidMotion) {
  const TriangleMesh cell = evans_fung_cell(3);
  const Point axis = scaled(1 / std::sqrt(14), {1, 2, 3});
  const TriangleMesh other = moved(cell, axis, 1.234, {7, -8, 9});
  EXPECT_NEAR(surface_area(other), surface_area(cell), 1e-11);
  EXPECT_NEAR(signed_volume(other), signed_volume(cell), 1e-11);
  EXPECT_NEAR(norm(difference(volume_centroid(other), {7, -8, 9})), 0, 1e-12);
  EXPECT_NEAR(edge_lengths(other).mean, edge_lengths(cell).mean, 1e-13);
  const PrincipalAxes turned = principal_axes(other);
  EXPECT_NEAR(turned.second_moment[0], principal_axes(cell).second_moment[0], 1e-10);
  const Point z = {0, 0, 1};
  const TriangleMesh pole = moved({{z}, {}}, axis, 1.234, {});
  EXPECT_NEAR(std::abs(dot(turned.axis[0], pole.positions[0])), 1, 1e-12) << "the short axis turns with the cell";
  for (const Hinge& h : find_hinges(cell)) ASSERT_NEAR(dihedral_angle(other, h), dihedral_angle(cell, h), 1e-12);
}

TEST(Dihedral, IsPositiveWhereConvex) {
  for (const Hinge& h : find_hinges(octahedral_sphere(3))) ASSERT_GT(dihedral_angle(octahedral_sphere(3), h), 0);
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  int flat = 0;
  for (const Hinge& h : find_hinges(cube)) {
    const double angle = dihedral_angle(cube, h);
    flat += std::abs(angle) < 1e-14;
    EXPECT_TRUE(std::abs(angle) < 1e-14 || std::abs(angle - pi / 2) < 1e-14) << angle;
  }
  EXPECT_EQ(flat, 6) << "the diagonals of the faces";
  // The dimple of a red cell is hollow (on average: the hinge of a badly placed edge may bend the other way).
  const TriangleMesh cell = evans_fung_cell(4);
  double dimple = 0, rim = 0;
  for (const Hinge& h : find_hinges(cell)) {
    const Point& p = cell.positions[static_cast<std::size_t>(h.a)];
    const Point edge = difference(cell.positions[static_cast<std::size_t>(h.b)], p);
    (std::hypot(p[0], p[1]) < 1 ? dimple : rim) += norm(edge) * dihedral_angle(cell, h) / 2;
  }
  EXPECT_LT(dimple, -0.5);
  EXPECT_GT(rim, 10) << "um, the integral of the mean curvature";
}

}  // namespace
}  // namespace npfem
