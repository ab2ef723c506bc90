// SPDX-License-Identifier: MPL-2.0
#include "communicator/decomposition.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "communicator/communicator.h"

namespace npfem::flow {
namespace {

class AnyRankCount : public testing::TestWithParam<int> {};

TEST_P(AnyRankCount, EveryNodeHasOneOwner) {
  const Index3 nodes{37, 19, 23};
  const Decomposition split(nodes, {true, false, true}, GetParam());
  ASSERT_EQ(split.ranks(), GetParam());
  std::int64_t total = 0;
  for (int rank = 0; rank < split.ranks(); ++rank) total += split.box(rank).nodes();
  EXPECT_EQ(total, 37 * 19 * 23);
  for (int iz = 0; iz < nodes[2]; ++iz) {
    for (int iy = 0; iy < nodes[1]; ++iy) {
      for (int ix = 0; ix < nodes[0]; ++ix) {
        ASSERT_TRUE(split.box(split.owner_of(ix, iy, iz)).contains(ix, iy, iz)) << ix << ' ' << iy << ' ' << iz;
      }
    }
  }
}

TEST_P(AnyRankCount, NeighboursShareAFace) {
  const Index3 nodes{37, 19, 23};
  const Decomposition split(nodes, {true, false, true}, GetParam());
  for (int rank = 0; rank < split.ranks(); ++rank) {
    const Box box = split.box(rank);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = std::size_t(axis);
      const int above = split.neighbour(rank, axis, +1);
      if (above == kNoRank) {
        EXPECT_EQ(axis, 1);
        EXPECT_EQ(box.end[a], nodes[a]);
        continue;
      }
      EXPECT_EQ(split.neighbour(above, axis, -1), rank);
      EXPECT_EQ(split.box(above).begin[a], box.end[a] % nodes[a]);
      for (std::size_t other = 0; other < 3; ++other) {
        if (other == a) continue;
        EXPECT_EQ(split.box(above).begin[other], box.begin[other]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, AnyRankCount, testing::Range(1, 18));

TEST(Decomposition, CutsWhereTheSurfaceIsSmallest) {
  EXPECT_EQ(Decomposition({100, 20, 20}, {true, false, false}, 4).blocks(), (Index3{4, 1, 1}));
  EXPECT_EQ(Decomposition({40, 40, 40}, {false, false, false}, 8).blocks(), (Index3{2, 2, 2}));
  EXPECT_EQ(Decomposition({40, 40, 40}, {true, true, true}, 2).blocks(), (Index3{1, 1, 2}));
}

TEST(Decomposition, WrapsPeriodicAxesOnly) {
  const Decomposition split({5, 1, 7}, {true, true, false}, 1);
  EXPECT_EQ(split.wrap(0, -2), 3);
  EXPECT_EQ(split.wrap(0, 6), 1);
  EXPECT_EQ(split.wrap(1, -2), 0);
  EXPECT_EQ(split.wrap(2, -1), -1);
  EXPECT_EQ(split.neighbour(0, 1, -1), 0);
  EXPECT_EQ(split.neighbour(0, 2, -1), kNoRank);
}

std::string refusal(const Index3& nodes, int ranks) {
  try {
    const Decomposition split(nodes, {true, true, true}, ranks);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Decomposition, SaysWhatIsAllowed) {
  EXPECT_EQ(refusal({8, 8, 8}, 17),
            "8 x 8 x 8 nodes do not split into 17 blocks at least 2 nodes thick; use 16 ranks or a larger grid");
  EXPECT_EQ(refusal({8, 0, 8}, 1), "a grid of 8 x 0 x 8 nodes; each direction needs at least 1");
  EXPECT_EQ(refusal({8, 8, 8}, 0), "0 ranks; at least 1 is needed");
}

}  // namespace
}  // namespace npfem::flow
