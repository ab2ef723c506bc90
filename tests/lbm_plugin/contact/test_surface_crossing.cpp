// SPDX-License-Identifier: MPL-2.0
#include "contact/surface_crossing.h"

#include <gtest/gtest.h>

#include "cell_shapes.h"
#include "communicator/serial_communicator.h"

namespace npfem::flow {
namespace {

Domain box() {
  Domain domain;
  domain.nodes = {40, 40, 40};
  domain.dx = 0.5;
  return domain;
}

CellSurface moved(const CellType& type, int id, const Vec3& centre, const Vec3& stretch = {1, 1, 1}) {
  CellSurface cell{id, 0, type.shape};
  for (std::size_t i = 0; i < cell.positions.size(); ++i) {
    cell.positions[i] = stretch[i % 3] * cell.positions[i] + centre[i % 3];
  }
  return cell;
}

TEST(SegmentCrosses, OnlyTheInsideOfATriangle) {
  const Corners triangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  EXPECT_TRUE(segment_crosses({0.2, 0.2, -1}, {0.2, 0.2, 1}, triangle));
  EXPECT_TRUE(segment_crosses({0.2, 0.2, 1}, {0.2, 0.2, -1}, triangle));
  EXPECT_FALSE(segment_crosses({0.2, 0.2, 0.1}, {0.2, 0.2, 1}, triangle)) << "it ends before";
  EXPECT_FALSE(segment_crosses({0.7, 0.7, -1}, {0.7, 0.7, 1}, triangle)) << "it passes by";
  EXPECT_FALSE(segment_crosses({-0.1, 0.2, -1}, {-0.1, 0.2, 1}, triangle));
}

// Two long octahedra side by side, their edges through each other, all vertices outside.
TEST(CountCrossings, SeesEdgesThatNoVertexTellsOf) {
  const CellType octahedron = testing::sphere(1.0, 0);
  const std::vector<CellType> types{octahedron};
  const std::vector<CellSurface> cells{moved(octahedron, 0, {10, 10, 10}, {4, 1, 1}),
                                       moved(octahedron, 1, {10, 10, 11.5}, {1, 4, 1})};
  SerialCommunicator alone;
  EXPECT_GT(count_crossings(box(), types, alone, cells), 0);
  const std::vector<CellSurface> apart{cells[0], moved(octahedron, 1, {10, 10, 12.1}, {1, 4, 1})};
  EXPECT_EQ(count_crossings(box(), types, alone, apart), 0);
}

TEST(CountCrossings, GoesAroundPeriodicFaces) {
  SerialCommunicator alone;
  const CellType sphere = testing::sphere(2.0, 2);
  const std::vector<CellType> types{sphere};
  const std::vector<CellSurface> cells{moved(sphere, 0, {1, 10, 10}), moved(sphere, 1, {77.5, 10, -10})};
  EXPECT_GT(count_crossings(box(), types, alone, cells), 0);
  const std::vector<CellSurface> apart{cells[0], moved(sphere, 1, {76.5, 10, -10})};
  EXPECT_EQ(count_crossings(box(), types, alone, apart), 0);
}

TEST(CountCrossings, SeesACellInItsOwnImage) {
  const CellType sphere = testing::sphere(2.0, 2);
  Domain narrow = box();
  narrow.nodes[0] = 7;
  SerialCommunicator alone;
  const std::vector<CellSurface> cells{moved(sphere, 0, {1, 10, 10})};
  EXPECT_GT(count_crossings(narrow, std::vector<CellType>{sphere}, alone, cells), 0);
}

}  // namespace
}  // namespace npfem::flow
