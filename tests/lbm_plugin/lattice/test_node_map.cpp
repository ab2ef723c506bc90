// SPDX-License-Identifier: MPL-2.0
#include "lattice/node_map.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <stdexcept>
#include <string>

#include "flows.h"

namespace npfem::flow {
namespace {

NodeMap mapped(const Index3& nodes, const std::array<bool, 3>& periodic, const Geometry& geometry) {
  return {Decomposition(nodes, periodic, 1), 0, geometry};
}

std::int64_t fluid_in_rows(const NodeMap& map) {
  std::int64_t fluid = 0;
  for (const auto rows : {map.rows_near_neighbours(), map.rows_inside()}) {
    for (const NodeMap::Row row : rows) {
      for (const FluidStrip& strip : row) fluid += std::popcount(strip.fluid);
    }
  }
  return fluid;
}

TEST(NodeMap, BothLayersBeyondAFaceBelongToItsWall) {
  const NodeMap map = mapped({4, 6, 3}, {true, false, true}, flows::plates(1, 6, {}, {}));
  EXPECT_EQ(map.fluid_nodes(), 72);
  EXPECT_EQ(fluid_in_rows(map), 72);
  EXPECT_EQ(map.type(0, -1, 0), wall(0));
  EXPECT_EQ(map.type(-2, -2, -2), wall(0));
  EXPECT_EQ(map.type(5, 7, 4), wall(1));
}

TEST(NodeMap, NumbersEveryNodeThatAStencilMayTouchOnce) {
  const NodeMap map = mapped({21, 13, 13}, {true, false, false}, flows::tube(13, 5.0));
  std::set<NodeNumber> numbers;
  map.for_each_fluid_node([&](int ix, int iy, int iz) {
    for (int dz = -2; dz <= 2; ++dz) {
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          const NodeNumber number = map.number(ix + dx, iy + dy, iz + dz);
          ASSERT_NE(number, NodeMap::kNoNode);
          numbers.insert(number);
        }
      }
    }
    for (int dx = 1; dx <= 2; ++dx) EXPECT_EQ(map.number(ix + dx, iy, iz), map.number(ix, iy, iz) + dx);
  });
  EXPECT_EQ(map.fluid_nodes(), fluid_in_rows(map));
  EXPECT_LE(numbers.size(), map.strips() * NodeMap::kStrip);
}

TEST(NodeMap, DeepInASolidNothingIsStored) {
  // A tube of a fifth of the section.
  const NodeMap map = mapped({64, 80, 80}, {true, false, false}, flows::tube(80, 20.0));
  EXPECT_EQ(map.number(5, 2, 2), NodeMap::kNoNode);
  const double share = static_cast<double>(map.strips()) / (10.0 * 84 * 84);
  EXPECT_LT(share, 0.30);
}

TEST(NodeMap, AnObstacleIsLeftOut) {
  const Geometry geometry{[](int ix, int iy, int iz) { return ix == 2 && iy == 1 && iz == 1 ? wall(0) : kFluid; },
                          {Boundary{}}};
  const NodeMap map = mapped({6, 3, 3}, {true, true, true}, geometry);
  EXPECT_EQ(map.fluid_nodes(), 53);
  EXPECT_EQ(fluid_in_rows(map), 53);
}

std::string refusal(const std::array<bool, 3>& periodic, const Geometry& geometry) {
  try {
    mapped({4, 4, 4}, periodic, geometry);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NodeMap, RefusesAnOpenOrUnknownWall) {
  EXPECT_EQ(refusal({true, true, false}, flows::periodic()),
            "node (2, 2, -1) is fluid but lies beyond a face that is not periodic; there it must be a wall");
  const Geometry geometry{[](int ix, int iy, int iz) { return ix + iy + iz == 0 ? wall(3) : kFluid; }, {Boundary{}}};
  EXPECT_EQ(refusal({true, true, true}, geometry), "node (0, 0, 0) belongs to boundary 3, but there are 1 boundaries");
}

}  // namespace
}  // namespace npfem::flow
