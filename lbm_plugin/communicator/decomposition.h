// SPDX-License-Identifier: MPL-2.0
#pragma once

// The grid of fluid nodes cut into one block per rank: px x py x pz blocks with the smallest surface between them if
// they were of equal size. Each axis is cut where its blocks are of nearly equal weight. The same on every rank, and
// the same every time.

#include <array>
#include <cstdint>
#include <vector>

namespace npfem::flow {

using Index3 = std::array<int, 3>;

// Nodes begin <= i < end in each direction.
struct Box {
  Index3 begin{};
  Index3 end{};

  int size(int axis) const { return end[std::size_t(axis)] - begin[std::size_t(axis)]; }
  std::int64_t nodes() const { return std::int64_t{size(0)} * size(1) * size(2); }
  bool contains(int ix, int iy, int iz) const {
    return ix >= begin[0] && ix < end[0] && iy >= begin[1] && iy < end[1] && iz >= begin[2] && iz < end[2];
  }
};

// By axis and node along it: the work in the plane of nodes normal to the axis there, in any unit. An empty axis is cut
// into equal lengths.
using PlaneWeights = std::array<std::vector<std::int64_t>, 3>;

class Decomposition {
 public:
  // A block that has a neighbour other than itself must hold the two layers of nodes that the neighbour copies.
  static constexpr int kSmallestBlock = 2;

  // std::invalid_argument where the ranks do not fit into the grid.
  Decomposition(const Index3& nodes, const std::array<bool, 3>& periodic, int ranks, const PlaneWeights& weights = {});

  const Index3& nodes() const { return nodes_; }
  bool periodic(int axis) const { return periodic_[std::size_t(axis)]; }
  int ranks() const { return blocks_[0] * blocks_[1] * blocks_[2]; }
  const Index3& blocks() const { return blocks_; }

  Box box(int rank) const;
  // The rank that holds a node of the grid (0 <= i < nodes in each direction).
  int owner_of(int ix, int iy, int iz) const { return rank_of({block_of(0, ix), block_of(1, iy), block_of(2, iz)}); }
  // The rank beyond the low (side -1) or high (side +1) face; the rank itself where a periodic axis is not cut;
  // kNoRank beyond a face that is not periodic.
  int neighbour(int rank, int axis, int side) const;

  // A node index carried back into the grid where the axis is periodic; unchanged where it is not.
  int wrap(int axis, int i) const {
    const int n = nodes_[std::size_t(axis)];
    return periodic(axis) ? ((i % n) + n) % n : i;
  }
  // One number per node of the grid, whatever the decomposition.
  std::int64_t global_id(int ix, int iy, int iz) const {
    return ix + std::int64_t{nodes_[0]} * (iy + std::int64_t{nodes_[1]} * iz);
  }

 private:
  int block_of(std::size_t axis, int i) const { return block_of_[axis][std::size_t(i)]; }
  int rank_of(const Index3& block) const { return block[0] + blocks_[0] * (block[1] + blocks_[1] * block[2]); }
  Index3 block_at(int rank) const;

  Index3 nodes_;
  std::array<bool, 3> periodic_;
  Index3 blocks_;
  std::array<std::vector<int>, 3> begin_;     // by axis and block, and the end of the last
  std::array<std::vector<int>, 3> block_of_;  // by axis and node
};

}  // namespace npfem::flow
