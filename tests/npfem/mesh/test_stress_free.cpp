// SPDX-License-Identifier: MPL-2.0
#include "mesh/stress_free.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error.h"
#include "mesh/generate.h"
#include "mesh/geometry.h"
#include "mesh/mesh_check.h"
#include "mesh/point_math.h"

namespace npfem {
namespace {

TEST(StressFree, HasTheAreaOfTheCellAndTheReducedVolume) {
  for (const double v : {0.7, 0.9, 0.95, 1.0}) {
    const TriangleMesh cell = evans_fung_cell(5);
    const TriangleMesh reference = oblate_reference(cell, v);
    EXPECT_NEAR(surface_area(reference) / surface_area(cell), 1, 1e-13);
    EXPECT_NEAR(reduced_volume(reference), v, 2e-3) << "the rest is the mesh: second order";
    EXPECT_NO_THROW(require_valid_surface(reference, "reference"));
    EXPECT_EQ(reference.triangles, cell.triangles);
  }
}

TEST(StressFree, LiesOnASpheroid) {
  const TriangleMesh reference = oblate_reference(evans_fung_cell(4), 0.95);
  const double a = extents(reference)[0] / 2, c = extents(reference)[2] / 2;
  EXPECT_LT(c, a);
  for (const Point& p : reference.positions) {
    EXPECT_NEAR((p[0] * p[0] + p[1] * p[1]) / (a * a) + p[2] * p[2] / (c * c), 1, 1e-12);
  }
}

TEST(StressFree, KeepsLocalArea) {
  // Area-preserving up to the mesh: the rms change of the vertex areas falls with refinement.
  double last = 1;
  for (int level = 3; level < 6; ++level) {
    const TriangleMesh cell = evans_fung_cell(level);
    const std::vector<double> before = vertex_areas(oblate_reference(cell, 0.95)), after = vertex_areas(cell);
    double square = 0;
    for (std::size_t i = 0; i < before.size(); ++i) square += std::pow(after[i] / before[i] - 1, 2);
    const double rms = std::sqrt(square / static_cast<double>(before.size()));
    EXPECT_LT(rms, 0.6 * last);
    last = rms;
  }
  EXPECT_LT(last, 0.01);
}

TEST(StressFree, ASpheroidIsItsOwnReference) {
  const TriangleMesh cell = oblate_spheroid(5, 6, 4);
  const double a = 3, c = 2, e = std::sqrt(1 - c * c / (a * a));
  const double area = 2 * std::numbers::pi * a * a * (1 + (1 - e * e) * std::atanh(e) / e);
  const double v = 6 * std::sqrt(std::numbers::pi) * (4 * std::numbers::pi / 3 * a * a * c) / std::pow(area, 1.5);
  const TriangleMesh reference = oblate_reference(cell, v);
  for (std::size_t i = 0; i < cell.positions.size(); ++i) {
    EXPECT_LT(norm(difference(cell.positions[i], reference.positions[i])), 0.01);
  }
}

TEST(StressFree, KeepsLongitudeAndSide) {
  const TriangleMesh cell = evans_fung_cell(3), reference = oblate_reference(cell, 0.95);
  for (std::size_t i = 0; i < cell.positions.size(); ++i) {
    const Point &p = cell.positions[i], &q = reference.positions[i];
    EXPECT_NEAR(p[0] * q[1] - p[1] * q[0], 0, 1e-12);
    EXPECT_GE(p[0] * q[0] + p[1] * q[1], 0);
    EXPECT_GE(p[2] * q[2], 0);
  }
}

TEST(StressFree, RefusesWhatIsNotASurfaceOfRevolution) {
  TriangleMesh turned = evans_fung_cell(3);
  for (Point& p : turned.positions) p = {p[2], p[0], p[1]};
  EXPECT_THROW(oblate_reference(turned, 0.95), Error);
  TriangleMesh shifted = evans_fung_cell(3);
  for (Point& p : shifted.positions) p[2] += 1;
  EXPECT_THROW(oblate_reference(shifted, 0.95), Error);
  for (const double v : {0.0, -1.0, 1.1, std::nan("")}) EXPECT_THROW(oblate_reference(evans_fung_cell(2), v), Error);
}

}  // namespace
}  // namespace npfem
