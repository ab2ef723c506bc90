// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "cell_shapes.h"
#include "geometry/cell_shape.h"

namespace npfem::flow {
namespace {

std::vector<double> moved(const std::vector<double>& xyz, const Rotation& turn, const Vec3& shift) {
  std::vector<double> out;
  for (std::size_t v = 0; v < xyz.size(); v += 3) {
    const Vec3 p = add(shift, rotate(turn, {xyz[v], xyz[v + 1], xyz[v + 2]}));
    out.insert(out.end(), p.begin(), p.end());
  }
  return out;
}

TEST(CellShape, OfASphere) {
  const CellType ball = testing::sphere(2.0, 4);
  const CellShape shape = shape_of(ball.shape, ball.triangles);
  for (const double axis : shape.semi_axes) EXPECT_NEAR(axis, 2.0, 0.01);
  EXPECT_NEAR(shape.deformation, 0, 1e-9);
  EXPECT_NEAR(enclosed_volume(ball.shape, ball.triangles), 32 * std::numbers::pi / 3, 0.2);
}

/// An ellipsoid is its own equivalent ellipsoid, wherever it is and however it is turned.
TEST(CellShape, OfATurnedEllipsoid) {
  CellType ellipsoid = testing::unit_sphere(4);
  for (std::size_t v = 0; v < ellipsoid.shape.size(); v += 3) {
    ellipsoid.shape[v] *= 4;
    ellipsoid.shape[v + 1] *= 3;
    ellipsoid.shape[v + 2] *= 1;
  }
  const Rotation turn = rotation_about_xyz({0.4, -0.8, 2.1});
  const CellShape shape = shape_of(moved(ellipsoid.shape, turn, {100, -50, 7}), ellipsoid.triangles);
  // the polyhedron lies inside the ellipsoid: half a percent smaller, in proportion
  EXPECT_NEAR(shape.semi_axes[0], 4, 0.02);
  EXPECT_NEAR(shape.semi_axes[1] / shape.semi_axes[0], 0.75, 1e-9);
  EXPECT_NEAR(shape.semi_axes[2] / shape.semi_axes[0], 0.25, 1e-9);
  EXPECT_NEAR(shape.deformation, 0.6, 1e-9);
  EXPECT_NEAR(shape.centre[0], 100, 1e-9);
  EXPECT_NEAR(shape.centre[1], -50, 1e-9);
  EXPECT_NEAR(shape.centre[2], 7, 1e-9);
  EXPECT_NEAR(std::abs(dot(shape.normal, rotate(turn, {0, 0, 1}))), 1, 1e-12);
  EXPECT_GE(shape.normal[2], 0);
}

}  // namespace
}  // namespace npfem::flow
