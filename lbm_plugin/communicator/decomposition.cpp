// SPDX-License-Identifier: MPL-2.0
#include "communicator/decomposition.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "communicator/communicator.h"

namespace npfem::flow {
namespace {

// Nodes on all cuts between blocks.
std::int64_t cut_surface(const Index3& nodes, const std::array<bool, 3>& periodic, const Index3& blocks) {
  std::int64_t surface = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t section = std::int64_t{nodes[(axis + 1) % 3]} * nodes[(axis + 2) % 3];
    const bool wraps = periodic[axis] && blocks[axis] > 1;
    surface += section * (blocks[axis] - 1 + (wraps ? 1 : 0));
  }
  return surface;
}

bool fits(const Index3& nodes, const Index3& blocks) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (blocks[axis] > 1 && nodes[axis] / blocks[axis] < Decomposition::kSmallestBlock) return false;
  }
  return true;
}

// Of equally good splits the one with the fewest cuts across x, along which memory runs, then across y.
std::optional<Index3> best_blocks(const Index3& nodes, const std::array<bool, 3>& periodic, int ranks) {
  std::optional<Index3> best;
  for (int px = 1; px <= ranks; ++px) {
    if (ranks % px != 0) continue;
    for (int py = 1; py <= ranks / px; ++py) {
      if (ranks / px % py != 0) continue;
      const Index3 blocks{px, py, ranks / px / py};
      if (!fits(nodes, blocks)) continue;
      if (!best || cut_surface(nodes, periodic, blocks) < cut_surface(nodes, periodic, *best)) best = blocks;
    }
  }
  return best;
}

// Where `blocks` blocks of an axis of n nodes begin, and the end of the last: each cut where the weight before it is
// nearest to its share, as far as the smallest block allows.
std::vector<int> begin_of_blocks(int n, int blocks, const std::vector<std::int64_t>& weights) {
  std::vector<std::int64_t> before(std::size_t(n) + 1);  // weight of the planes before each
  for (std::size_t i = 0; i < std::size_t(n); ++i) before[i + 1] = before[i] + (weights.empty() ? 1 : weights[i]);
  const std::int64_t whole = before.back();
  std::vector<int> begin(std::size_t(blocks) + 1, n);
  begin[0] = 0;
  for (int b = 1; b < blocks; ++b) {
    const int first = begin[std::size_t(b) - 1] + Decomposition::kSmallestBlock;
    const int last = n - (blocks - b) * Decomposition::kSmallestBlock;
    int cut = int(std::int64_t{b} * n / blocks);
    if (!weights.empty() && whole > 0) {
      // block * before <= b * whole: the last cut that leaves no more than its share before it
      const auto past = std::upper_bound(before.begin(), before.end(), b * whole,
                                         [&](std::int64_t share, std::int64_t sum) { return share < blocks * sum; });
      cut = int(past - before.begin()) - 1;
      const auto low = before[std::size_t(cut)], high = before[std::min(std::size_t(cut) + 1, std::size_t(n))];
      if (blocks * high - b * whole < b * whole - blocks * low) ++cut;
    }
    begin[std::size_t(b)] = std::clamp(cut, first, last);
  }
  return begin;
}

std::string describe(const Index3& nodes) {
  return std::to_string(nodes[0]) + " x " + std::to_string(nodes[1]) + " x " + std::to_string(nodes[2]) + " nodes";
}

}  // namespace

Decomposition::Decomposition(const Index3& nodes, const std::array<bool, 3>& periodic, int ranks,
                             const PlaneWeights& weights)
    : nodes_(nodes), periodic_(periodic), blocks_{1, 1, 1} {
  for (const int n : nodes) {
    if (n < 1) throw std::invalid_argument("a grid of " + describe(nodes) + "; each direction needs at least 1");
  }
  if (ranks < 1) throw std::invalid_argument(std::to_string(ranks) + " ranks; at least 1 is needed");
  const std::optional<Index3> blocks = best_blocks(nodes, periodic, ranks);
  if (!blocks) {
    int fewer = ranks - 1;
    while (!best_blocks(nodes, periodic, fewer)) --fewer;
    throw std::invalid_argument(describe(nodes) + " do not split into " + std::to_string(ranks) +
                                " blocks at least 2 nodes thick; use " + std::to_string(fewer) +
                                " ranks or a larger grid");
  }
  blocks_ = *blocks;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    begin_[axis] = begin_of_blocks(nodes[axis], blocks_[axis], weights[axis]);
    block_of_[axis].resize(std::size_t(nodes[axis]));
    for (std::size_t b = 0; b < std::size_t(blocks_[axis]); ++b) {
      std::fill(block_of_[axis].begin() + begin_[axis][b], block_of_[axis].begin() + begin_[axis][b + 1], int(b));
    }
  }
}

Index3 Decomposition::block_at(int rank) const {
  return {rank % blocks_[0], rank / blocks_[0] % blocks_[1], rank / blocks_[0] / blocks_[1]};
}

Box Decomposition::box(int rank) const {
  const Index3 block = block_at(rank);
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.begin[axis] = begin_[axis][std::size_t(block[axis])];
    box.end[axis] = begin_[axis][std::size_t(block[axis]) + 1];
  }
  return box;
}

int Decomposition::neighbour(int rank, int axis, int side) const {
  const auto a = std::size_t(axis);
  Index3 block = block_at(rank);
  block[a] += side;
  if (block[a] < 0 || block[a] >= blocks_[a]) {
    if (!periodic_[a]) return kNoRank;
    block[a] = (block[a] + blocks_[a]) % blocks_[a];
  }
  return rank_of(block);
}

}  // namespace npfem::flow
