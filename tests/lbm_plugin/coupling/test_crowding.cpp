// SPDX-License-Identifier: MPL-2.0
#include "coupling/crowding.h"

#include <gtest/gtest.h>

#include <numeric>

#include "capsules.h"

namespace npfem::flow {
namespace {

TEST(Crowding, CountsOtherCellsAndWallsWithinOneNode) {
  const flow::Setup setup = capsules::fluid(DomainKind::shear_box, {10, 10, 10}, 1.0);
  const Decomposition grid({10, 10, 10}, {true, false, true}, 1);
  KnownVertices known;
  const auto put = [&](int cell, const Vec3& at) {
    known.id.push_back({cell, 0});
    known.position.insert(known.position.end(), at.begin(), at.end());
    known.in_nodes.insert(known.in_nodes.end(), at.begin(), at.end());
    known.held.push_back(static_cast<int>(known.held.size()));
  };
  put(0, {0.1, 5, 5});
  put(0, {0.3, 5, 5});      // only its own cell is near
  put(1, {9.2, 5, 5.3});    // near the first through the periodic face
  put(2, {3, 0.9, 5});      // near the wall
  put(3, {5, 5.9, 25});     // unwrapped: z 5
  put(4, {5.6, 5.9, 5.7});  // in reach of the one before
  put(5, {5, 5.9, 6.1});    // 1.1 from one, near the other
  EXPECT_EQ(crowded_vertices(known, grid, setup.domain), (std::vector<double>{1, 0, 1, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace npfem::flow
