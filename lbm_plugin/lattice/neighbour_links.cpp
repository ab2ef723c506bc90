// SPDX-License-Identifier: MPL-2.0
#include "lattice/neighbour_links.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace npfem::flow {
namespace {

using d3q19::kVelocity;

// A node beyond the own box as the node of the whole grid that it copies; none beyond a face that is not periodic.
std::optional<Index3> in_grid(const Decomposition& decomposition, Index3 node) {
  for (int axis = 0; axis < 3; ++axis) {
    int& i = node[static_cast<std::size_t>(axis)];
    i = decomposition.wrap(axis, i);
    if (i < 0 || i >= decomposition.nodes()[static_cast<std::size_t>(axis)]) return std::nullopt;
  }
  return node;
}

struct Places {
  const Decomposition& decomposition;
  const NodeMap& nodes;

  Index3 global(const Index3& local) const {
    const Index3& first = nodes.own().begin;
    return {local[0] + first[0], local[1] + first[1], local[2] + first[2]};
  }
  NodeNumber number(const Index3& local) const { return nodes.number(local[0], local[1], local[2]); }
  NodeNumber number_of_own(const Index3& global) const {
    const Index3& first = nodes.own().begin;
    return nodes.number(global[0] - first[0], global[1] - first[1], global[2] - first[2]);
  }
  bool is_own(const Index3& local) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int i = local[static_cast<std::size_t>(axis)];
      if (i < 0 || i >= nodes.size(axis)) return false;
    }
    return true;
  }
  bool is_fluid(const Index3& local) const { return nodes.type(local[0], local[1], local[2]) == kFluid; }
  int owner(const Index3& global) const { return decomposition.owner_of(global[0], global[1], global[2]); }
};

Index3 moved(const Index3& node, const std::array<int, 3>& by, int sign) {
  return {node[0] + sign * by[0], node[1] + sign * by[1], node[2] + sign * by[2]};
}

// A link by the global id of its lower node and its direction, and the index that belongs to it.
using KeyedIndex = std::pair<std::int64_t, std::ptrdiff_t>;

std::vector<std::ptrdiff_t> in_order(std::vector<KeyedIndex>& keyed) {
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::ptrdiff_t> indices;
  for (const KeyedIndex& entry : keyed) indices.push_back(entry.second);
  return indices;
}

void begin(PackedMessages& messages, std::size_t peers) {
  messages.sent.resize(peers);
  messages.received.resize(peers);
  messages.outgoing.clear();
  messages.expected.clear();
}

template <class Number>
std::span<Number> as_numbers(Bytes& bytes, std::size_t count) {
  bytes.resize(count * sizeof(Number));
  return {reinterpret_cast<Number*>(bytes.data()), count};
}

}  // namespace

PopulationExchange::PopulationExchange(Communicator& communicator, const Decomposition& decomposition,
                                       const NodeMap& nodes)
    : communicator_(communicator) {
  struct Keyed {
    std::vector<KeyedIndex> lower_mine, upper_mine;
  };
  std::map<int, Keyed> keyed;
  const Places places{decomposition, nodes};
  nodes.for_each_fluid_node([&](int ix, int iy, int iz) {
    const Index3 node{ix, iy, iz};
    for (int i = 1; i < d3q19::kDirections; i += 2) {
      for (const bool is_lower : {true, false}) {
        const Index3 other = moved(node, kVelocity[static_cast<std::size_t>(i)], is_lower ? 1 : -1);
        if (places.is_own(other) || !places.is_fluid(other)) continue;
        const Index3 there = *in_grid(decomposition, places.global(other));
        const Index3 lower = is_lower ? places.global(node) : there;
        const std::int64_t key = decomposition.global_id(lower[0], lower[1], lower[2]) * d3q19::kDirections + i;
        const NodeNumber upper = places.number(is_lower ? other : node);
        const int owner = places.owner(there);
        if (owner != communicator.rank()) {
          auto& links = is_lower ? keyed[owner].lower_mine : keyed[owner].upper_mine;
          links.emplace_back(key, population_index(upper, i + 1));
        } else if (is_lower) {
          own_pairs_.push_back({population_index(upper, i + 1), population_index(places.number_of_own(there), i + 1)});
        }
      }
    }
  });
  for (auto& [rank, links] : keyed) peers_.push_back({rank, in_order(links.lower_mine), in_order(links.upper_mine)});
}

template <class Real>
void PopulationExchange::start(const FluidFields<Real>& fields) {
  begin(messages_, peers_.size());
  const Real* const populations = fields.populations;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const Peer& peer = peers_[p];
    const std::size_t count = peer.lower_mine.size() + peer.upper_mine.size();
    Real* packed = as_numbers<Real>(messages_.sent[p], count).data();
    for (const std::ptrdiff_t link : peer.lower_mine) *packed++ = populations[link + far_shift(fields.odd_step)];
    for (const std::ptrdiff_t link : peer.upper_mine) *packed++ = populations[link + near_shift(fields.odd_step)];
    as_numbers<Real>(messages_.received[p], count);
    messages_.outgoing.push_back({peer.rank, messages_.sent[p]});
    messages_.expected.push_back({peer.rank, messages_.received[p]});
  }
  communicator_.start_messages(messages_.outgoing, messages_.expected);
}

template <class Real>
void PopulationExchange::finish(const FluidFields<Real>& fields) {
  Real* const populations = fields.populations;
  const std::ptrdiff_t near = near_shift(fields.odd_step), far = far_shift(fields.odd_step);
  for (const OwnPair& pair : own_pairs_) {
    populations[pair.own + far] = populations[pair.copy + far];
    populations[pair.copy + near] = populations[pair.own + near];
  }
  communicator_.finish_messages();
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const Peer& peer = peers_[p];
    const auto* arrived = reinterpret_cast<const Real*>(messages_.received[p].data());
    for (const std::ptrdiff_t link : peer.upper_mine) populations[link + far] = *arrived++;
    for (const std::ptrdiff_t link : peer.lower_mine) populations[link + near] = *arrived++;
  }
}

namespace {

// body(node of the halo of `box`, the node of the grid it copies), row after row.
template <class Body>
void for_each_halo_node(const Decomposition& decomposition, const Box& box, Body body) {
  constexpr int halo = NodeMap::kHalo;
  for (int iz = box.begin[2] - halo; iz < box.end[2] + halo; ++iz) {
    for (int iy = box.begin[1] - halo; iy < box.end[1] + halo; ++iy) {
      for (int ix = box.begin[0] - halo; ix < box.end[0] + halo; ++ix) {
        if (box.contains(ix, iy, iz)) {
          ix = box.end[0] - 1;
          continue;
        }
        if (const auto there = in_grid(decomposition, {ix, iy, iz})) body(Index3{ix, iy, iz}, *there);
      }
    }
  }
}

}  // namespace

VectorExchange::VectorExchange(Communicator& communicator, const Decomposition& decomposition, const NodeMap& nodes)
    : communicator_(communicator) {
  const Places places{decomposition, nodes};
  const Index3& first = nodes.own().begin;
  std::map<int, Peer> peers;
  for_each_halo_node(decomposition, nodes.own(), [&](const Index3& node, const Index3& there) {
    const Index3 local = moved(node, first, -1);
    if (!places.is_fluid(local)) return;
    const int owner = places.owner(there);
    if (owner != communicator.rank()) {
      peers[owner].received.push_back(places.number(local));
    } else if (places.number(local) != NodeMap::kNoNode) {
      own_pairs_.push_back({places.number(local), places.number_of_own(there)});
    }
  });
  for (auto& [rank, peer] : peers) {
    peer.rank = rank;
    for_each_halo_node(decomposition, decomposition.box(rank), [&](const Index3&, const Index3& there) {
      if (places.owner(there) != communicator.rank() || !places.is_fluid(moved(there, first, -1))) return;
      peer.sent.push_back(places.number_of_own(there));
    });
    peers_.push_back(std::move(peer));
  }
}

template <class Real>
void VectorExchange::fill_halo(Real* vectors) {
  const auto at = [&](NodeNumber node) { return vectors + 3 * std::ptrdiff_t{node}; };
  begin(messages_, peers_.size());
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const Peer& peer = peers_[p];
    Real* packed = as_numbers<Real>(messages_.sent[p], 3 * peer.sent.size()).data();
    for (const NodeNumber node : peer.sent) packed = std::copy_n(at(node), 3, packed);
    as_numbers<Real>(messages_.received[p], 3 * peer.received.size());
    messages_.outgoing.push_back({peer.rank, messages_.sent[p]});
    messages_.expected.push_back({peer.rank, messages_.received[p]});
  }
  communicator_.start_messages(messages_.outgoing, messages_.expected);
  for (const OwnPair& pair : own_pairs_) std::copy_n(at(pair.own), 3, at(pair.copy));
  communicator_.finish_messages();
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const auto* arrived = reinterpret_cast<const Real*>(messages_.received[p].data());
    for (const NodeNumber node : peers_[p].received) {
      if (node != NodeMap::kNoNode) std::copy_n(arrived, 3, at(node));
      arrived += 3;
    }
  }
}

template void PopulationExchange::start(const FluidFields<double>&);
template void PopulationExchange::start(const FluidFields<float>&);
template void PopulationExchange::finish(const FluidFields<double>&);
template void PopulationExchange::finish(const FluidFields<float>&);
template void VectorExchange::fill_halo(double*);
template void VectorExchange::fill_halo(float*);

}  // namespace npfem::flow
