// SPDX-License-Identifier: MPL-2.0
#include "lattice/node_map.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "flows.h"

namespace npfem::flow {
namespace {

struct Mapped {
  Decomposition split;
  LocalGrid grid;
  NodeMap map;
  Mapped(const Index3& nodes, const std::array<bool, 3>& periodic, const Geometry& geometry)
      : split(nodes, periodic, 1), grid(split.box(0), 2), map(split, grid, geometry) {}
};

TEST(NodeMap, PlatesHaveFiveLinksPerWallNode) {
  const Mapped mapped({4, 6, 3}, {true, false, true}, flows::plates(1, 6, {}, {}));
  EXPECT_EQ(mapped.map.fluid_nodes(), 72);
  std::size_t links = 0;
  for (int iz = 0; iz < 3; ++iz) {
    links += mapped.map.links(iz).size();
    EXPECT_EQ(mapped.map.runs(iz).size(), 6U);
    for (const WallLink& link : mapped.map.links(iz)) {
      const int c = d3q19::kVelocity[std::size_t(link.direction)][1];
      EXPECT_EQ(c, link.wall == 0 ? -1 : 1);
    }
  }
  EXPECT_EQ(links, 2U * 4 * 3 * 5);
  // Both layers beyond a face belong to its wall, also over the periodic edge.
  EXPECT_EQ(mapped.map.type(mapped.grid.index(0, -1, 0)), wall(0));
  EXPECT_EQ(mapped.map.type(mapped.grid.index(-2, -2, -2)), wall(0));
  EXPECT_EQ(mapped.map.type(mapped.grid.index(5, 7, 4)), wall(1));
}

TEST(NodeMap, AnObstacleSplitsRows) {
  const Geometry geometry{[](int ix, int iy, int iz) { return ix == 2 && iy == 1 && iz == 1 ? wall(0) : kFluid; },
                          {npfem::flow::Boundary{}}};
  const Mapped mapped({6, 3, 3}, {true, true, true}, geometry);
  EXPECT_EQ(mapped.map.fluid_nodes(), 53);
  ASSERT_EQ(mapped.map.runs(1).size(), 4U);
  EXPECT_EQ(mapped.map.runs(1)[1].length, 2);
  EXPECT_EQ(mapped.map.runs(1)[2].ix, 3);
  EXPECT_EQ(mapped.map.runs(1)[2].length, 3);
  std::size_t links = 0;
  for (int iz = 0; iz < 3; ++iz) links += mapped.map.links(iz).size();
  EXPECT_EQ(links, 18U);
}

std::string refusal(const std::array<bool, 3>& periodic, const Geometry& geometry) {
  try {
    const Mapped mapped({4, 4, 4}, periodic, geometry);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NodeMap, RefusesAnOpenOrUnknownWall) {
  EXPECT_EQ(refusal({true, true, false}, flows::periodic()),
            "node (2, 2, -1) is fluid but lies beyond a face that is not periodic; there it must be a wall");
  const Geometry geometry{[](int ix, int iy, int iz) { return ix + iy + iz == 0 ? wall(3) : kFluid; },
                          {npfem::flow::Boundary{}}};
  EXPECT_EQ(refusal({true, true, true}, geometry), "node (0, 0, 0) belongs to boundary 3, but there are 1 boundaries");
}

}  // namespace
}  // namespace npfem::flow
