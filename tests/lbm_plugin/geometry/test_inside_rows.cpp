// SPDX-License-Identifier: MPL-2.0
#include "geometry/inside_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "cell_shapes.h"
#include "geometry/cell_shape.h"

namespace npfem::flow {
namespace {

std::vector<double> moved(std::vector<double> xyz, const Vec3& by) {
  for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] += by[i % 3];
  return xyz;
}

std::int64_t nodes_in(const std::vector<NodeRow>& rows) {
  std::int64_t nodes = 0;
  for (const NodeRow& row : rows) nodes += row.end - row.begin;
  return nodes;
}

double volume_error(const std::vector<double>& xyz, const std::vector<std::int32_t>& triangles) {
  const double error = static_cast<double>(nodes_in(rows_inside(xyz, triangles))) / enclosed_volume(xyz, triangles) - 1;
  std::cout << "nodes over volume - 1: " << error << '\n';
  return error;
}

TEST(InsideRows, FillTheVolumeOfASphere) {
  const CellType cell = testing::sphere(6);
  for (const Vec3& centre : {Vec3{20.3, -7.1, 9.8}, Vec3{0.5, 0.5, 0.5}}) {
    EXPECT_LT(std::abs(volume_error(moved(cell.shape, centre), cell.triangles)), 0.02);
  }
}

// How many nodes a given place holds is chance (3 % more about a corner between eight nodes); on average it is the
// volume.
TEST(InsideRows, FillTheVolumeOnAverage) {
  const CellType cell = testing::sphere(6);
  double nodes = 0;
  for (int n = 0; n < 64; ++n) {
    const Vec3 centre{0.25 * (n % 4), 0.25 * (n / 4 % 4), 0.25 * (n / 16)};
    nodes += static_cast<double>(nodes_in(rows_inside(moved(cell.shape, centre), cell.triangles))) / 64;
  }
  const double volume = enclosed_volume(cell.shape, cell.triangles);
  EXPECT_NEAR(nodes, volume, 2e-3 * volume);
}

TEST(InsideRows, FillTheVolumeOfARedCell) {
  CellType cell = testing::red_cell();
  for (double& x : cell.shape) x /= 0.5;  // nodes of 0.5 um
  for (const Vec3& centre : {Vec3{20.3, -7.1, 9.8}, Vec3{0.5, 0.5, 0.5}}) {
    EXPECT_LT(std::abs(volume_error(moved(cell.shape, centre), cell.triangles)), 0.02);
  }
}

// Rows through all six vertices and along edges: |x| + |y| + |z| < 4 about a node.
TEST(InsideRows, DoNotLeakThroughVerticesAndEdges) {
  const double r = 4;
  const std::vector<double> xyz = moved({r, 0, 0, -r, 0, 0, 0, r, 0, 0, -r, 0, 0, 0, r, 0, 0, -r}, {0.5, 0.5, 0.5});
  const std::vector<std::int32_t> triangles{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  const auto inside = [&](int i, int j, int k) {
    for (const NodeRow& row : rows_inside(xyz, triangles)) {
      if (row.j == j && row.k == k && row.begin <= i && i < row.end) return true;
    }
    return false;
  };
  for (int k = -6; k <= 6; ++k) {
    for (int j = -6; j <= 6; ++j) {
      for (int i = -6; i <= 6; ++i) {
        const int distance = std::abs(i) + std::abs(j) + std::abs(k);
        if (distance == 4) continue;  // on the surface
        EXPECT_EQ(inside(i, j, k), distance < 4) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace npfem::flow
