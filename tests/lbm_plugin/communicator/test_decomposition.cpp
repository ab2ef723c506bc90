// SPDX-License-Identifier: MPL-2.0
#include "communicator/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
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

std::int64_t largest(const Decomposition& split, const std::function<int(int, int, int)>& weight) {
  std::int64_t most = 0;
  for (int rank = 0; rank < split.ranks(); ++rank) {
    const Box box = split.box(rank);
    std::int64_t sum = 0;
    for (int iz = box.begin[2]; iz < box.end[2]; ++iz) {
      for (int iy = box.begin[1]; iy < box.end[1]; ++iy) {
        for (int ix = box.begin[0]; ix < box.end[0]; ++ix) sum += weight(ix, iy, iz);
      }
    }
    most = std::max(most, sum);
  }
  return most;
}

// Fluid in the lower part of a box, and in a vessel that widens along z.
TEST(Decomposition, CutsByWeight) {
  const Index3 nodes{24, 40, 40};
  const std::array<std::function<int(int, int, int)>, 2> fluids{
      [](int, int iy, int) { return iy < 17 ? 1 : 0; },
      [](int ix, int iy, int iz) {
        return 4 * (std::pow(ix - 11.5, 2) + std::pow(iy - 19.5, 2)) < std::pow(4 + iz / 2, 2);
      }};
  for (const auto& fluid : fluids) {
    PlaneWeights weights;
    for (std::size_t axis = 0; axis < 3; ++axis) weights[axis].resize(static_cast<std::size_t>(nodes[axis]));
    std::int64_t whole = 0;
    for (int iz = 0; iz < nodes[2]; ++iz) {
      for (int iy = 0; iy < nodes[1]; ++iy) {
        for (int ix = 0; ix < nodes[0]; ++ix) {
          const int here = fluid(ix, iy, iz);
          weights[0][static_cast<std::size_t>(ix)] += here;
          weights[1][static_cast<std::size_t>(iy)] += here;
          weights[2][static_cast<std::size_t>(iz)] += here;
          whole += here;
        }
      }
    }
    const double mean = static_cast<double>(whole) / 4;
    const auto equal = static_cast<double>(largest({nodes, {true, false, false}, 4}, fluid));
    const auto weighed = static_cast<double>(largest({nodes, {true, false, false}, 4, weights}, fluid));
    std::cout << "largest block over the mean: " << equal / mean << " in equal blocks, " << weighed / mean
              << " by weight\n";
    EXPECT_GT(equal / mean, 1.3);
    EXPECT_LT(weighed / mean, 1.1);
  }
}

TEST_P(AnyRankCount, KeepsTheSmallestBlockWhateverTheWeights) {
  const Index3 nodes{37, 19, 23};
  PlaneWeights weights;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    weights[axis].assign(static_cast<std::size_t>(nodes[axis]), 0);
    weights[axis][axis == 1 ? 0 : static_cast<std::size_t>(nodes[axis]) - 1] = 1000;  // all in one plane
  }
  const Decomposition split(nodes, {true, false, true}, GetParam(), weights);
  std::int64_t total = 0;
  for (int rank = 0; rank < split.ranks(); ++rank) {
    const Box box = split.box(rank);
    total += box.nodes();
    for (int axis = 0; axis < 3; ++axis) EXPECT_GE(box.size(axis), Decomposition::kSmallestBlock);
    EXPECT_EQ(split.owner_of(box.begin[0], box.begin[1], box.begin[2]), rank);
    EXPECT_EQ(split.owner_of(box.end[0] - 1, box.end[1] - 1, box.end[2] - 1), rank);
  }
  EXPECT_EQ(total, 37 * 19 * 23);
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
