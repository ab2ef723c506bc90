// SPDX-License-Identifier: MPL-2.0
#include "coupling/vertex_exchange.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string>

#include "immersed_boundary/stencil.h"
#include "lattice/lattice.h"

namespace npfem::flow {
namespace {

Vec3 in_nodes(std::span<const double> positions, std::size_t vertex, double dx) {
  return {positions[3 * vertex] / dx, positions[3 * vertex + 1] / dx, positions[3 * vertex + 2] / dx};
}

void require_length(std::size_t found, std::size_t expected, int source) {
  if (found == expected) return;
  throw std::logic_error("vertex exchange: " + std::to_string(found) + " bytes from rank " + std::to_string(source) +
                         " where " + std::to_string(expected) + " were due");
}

}  // namespace

VertexExchange::VertexExchange(Communicator& communicator, const Decomposition& decomposition, double dx)
    : communicator_(communicator),
      decomposition_(decomposition),
      dx_(dx),
      own_(decomposition.box(communicator.rank())),
      near_fluid_(blocks_within(Lattice::kHalo)),
      near_contact_(near_fluid_),
      contact_reach_(Lattice::kHalo),
      links_(static_cast<std::size_t>(communicator.size())) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::vector<int>& near : near_fluid_[axis]) {
      const auto is_own = [&](int node) {
        Index3 probe = own_.begin;
        probe[axis] = node;
        return own_.contains(probe[0], probe[1], probe[2]);
      };
      feels_[axis].push_back(std::any_of(near.begin(), near.end(), is_own) ? 1 : 0);
    }
  }
}

VertexExchange::BlocksNear VertexExchange::blocks_within(int reach) const {
  BlocksNear blocks;
  for (int axis = 0; axis < 3; ++axis) {
    const auto block_of = [&](int node) {
      Index3 probe{};
      probe[static_cast<std::size_t>(axis)] = node;
      return decomposition_.owner_of(probe[0], probe[1], probe[2]);
    };
    auto& table = blocks[static_cast<std::size_t>(axis)];
    table.resize(static_cast<std::size_t>(decomposition_.nodes()[static_cast<std::size_t>(axis)]));
    for (int node = 0; node < static_cast<int>(table.size()); ++node) {
      auto& near = table[static_cast<std::size_t>(node)];
      for (int other = node - reach; other <= node + reach; ++other) {
        const int there = node_in_grid(decomposition_, axis, other);
        const bool seen = std::any_of(near.begin(), near.end(), [&](int n) { return block_of(n) == block_of(there); });
        if (!seen) near.push_back(there);
      }
    }
  }
  return blocks;
}

void VertexExchange::share_positions(std::span<const VertexId> ids, std::span<const double> positions,
                                     std::span<const double> expected, int contact_reach) {
  if (communicator_.size() == 1) return know_own(ids, positions, expected);
  const int reach = std::max(contact_reach, Lattice::kHalo);
  if (reach != contact_reach_) near_contact_ = blocks_within(reach);
  contact_reach_ = reach;
  plan(positions);
  outgoing_.clear();
  for (std::size_t rank = 0; rank < links_.size(); ++rank) {
    Link& link = links_[rank];
    link.records.clear();
    for (const int v : link.sent) {
      const auto i = static_cast<std::size_t>(v);
      link.records.push_back({ids[i],
                              {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]},
                              {expected[3 * i], expected[3 * i + 1], expected[3 * i + 2]}});
    }
    if (!link.records.empty()) outgoing_.push_back({static_cast<int>(rank), std::as_bytes(std::span(link.records))});
  }
  communicator_.exchange(outgoing_, incoming_);
  unpack_positions();
}

/// A rank that is alone knows, and holds, what it owns, in the same order.
void VertexExchange::know_own(std::span<const VertexId> ids, std::span<const double> positions,
                              std::span<const double> expected) {
  known_.id.assign(ids.begin(), ids.end());
  known_.position.assign(positions.begin(), positions.end());
  known_.in_nodes.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) known_.in_nodes[i] = positions[i] / dx_;
  known_.held.resize(ids.size());
  std::iota(known_.held.begin(), known_.held.end(), 0);
  contact_vertices_.id.assign(ids.begin(), ids.end());
  contact_vertices_.position.assign(expected.begin(), expected.end());
  contact_vertices_.held = known_.held;
}

template <class Visit>
void VertexExchange::for_each_rank_near(const BlocksNear& near, const Index3& node, Visit&& visit) const {
  for (const int z : near[2][static_cast<std::size_t>(node[2])]) {
    for (const int y : near[1][static_cast<std::size_t>(node[1])]) {
      for (const int x : near[0][static_cast<std::size_t>(node[0])]) {
        visit(static_cast<std::size_t>(decomposition_.owner_of(x, y, z)));
      }
    }
  }
}

void VertexExchange::plan(std::span<const double> positions) {
  for (Link& link : links_) {
    link.sent.clear();
    link.sent_near.clear();
    link.held_there.clear();
  }
  for (std::size_t i = 0; i < positions.size() / 3; ++i) {
    const Index3 node = node_in_grid(decomposition_, in_nodes(positions, i, dx_));
    const int v = static_cast<int>(i);
    const int holder = decomposition_.owner_of(node[0], node[1], node[2]);
    links_[static_cast<std::size_t>(holder)].held_there.push_back(v);
    for_each_rank_near(near_fluid_, node, [&](std::size_t rank) { links_[rank].sent_near.push_back(v); });
    for_each_rank_near(near_contact_, node, [&](std::size_t rank) { links_[rank].sent.push_back(v); });
  }
}

/// Merges the messages by cell. One rank owns a cell and sends its vertices in order, so whole runs are moved.
void VertexExchange::unpack_positions() {
  for (Link& link : links_) {
    link.around.clear();
    link.known.clear();
    link.held_here.clear();
  }
  runs_.clear();
  std::size_t total = 0;
  for (std::size_t m = 0; m < incoming_.size(); ++m) {
    const Bytes& bytes = incoming_[m].bytes;
    const std::size_t count = bytes.size() / sizeof(Record);
    require_length(bytes.size(), count * sizeof(Record), incoming_[m].source);
    for (std::size_t i = 0; i < count; ++i) {
      VertexId id;
      std::memcpy(&id, bytes.data() + i * sizeof(Record), sizeof id);
      const bool continues = i > 0 && runs_.back().cell == id.cell;
      if (!continues) runs_.push_back({id.cell, m, i, 0});
      ++runs_.back().count;
    }
    links_[static_cast<std::size_t>(incoming_[m].source)].around.resize(count);
    total += count;
  }
  std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.cell < b.cell; });

  known_.id.clear();
  known_.position.clear();
  known_.in_nodes.clear();
  known_.held.clear();
  contact_vertices_.id.resize(total);
  contact_vertices_.position.resize(3 * total);
  contact_vertices_.held.clear();
  std::size_t at = 0;
  for (const Run& run : runs_) {
    place(run, at);
    at += run.count;
  }
}

void VertexExchange::place(const Run& run, std::size_t at) {
  const Incoming& message = incoming_[run.message];
  Link& link = links_[static_cast<std::size_t>(message.source)];
  for (std::size_t i = 0; i < run.count; ++i) {
    Record record;
    std::memcpy(&record, message.bytes.data() + (run.first + i) * sizeof(Record), sizeof record);
    const std::size_t k = at + i;
    contact_vertices_.id[k] = record.id;
    std::copy_n(record.expected, 3, &contact_vertices_.position[3 * k]);
    link.around[run.first + i] = static_cast<int>(k);
    take_known(record, static_cast<int>(k), link);
  }
}

/// Adds the vertex to those that the fluid here feels, and to those held here, where it belongs there; `place`: among
/// the contact vertices. Both are listed in the order of the owner's message, for a run is placed in that order.
void VertexExchange::take_known(const Record& record, int place, Link& link) {
  const Vec3 nodes{record.position[0] / dx_, record.position[1] / dx_, record.position[2] / dx_};
  const Index3 node = node_in_grid(decomposition_, nodes);
  if (!fluid_feels(node)) return;
  const int k = static_cast<int>(known_.id.size());
  known_.id.push_back(record.id);
  known_.position.insert(known_.position.end(), record.position, record.position + 3);
  known_.in_nodes.insert(known_.in_nodes.end(), nodes.begin(), nodes.end());
  link.known.push_back(k);
  if (!own_.contains(node[0], node[1], node[2])) return;
  link.held_here.push_back(static_cast<int>(known_.held.size()));
  known_.held.push_back(k);
  contact_vertices_.held.push_back(place);
}

bool VertexExchange::fluid_feels(const Index3& node) const {
  return feels_[0][static_cast<std::size_t>(node[0])] && feels_[1][static_cast<std::size_t>(node[1])] &&
         feels_[2][static_cast<std::size_t>(node[2])];
}

void VertexExchange::exchange_messages() {
  outgoing_.clear();
  for (std::size_t rank = 0; rank < links_.size(); ++rank) {
    if (!links_[rank].message.empty()) outgoing_.push_back({static_cast<int>(rank), links_[rank].message});
  }
  communicator_.exchange(outgoing_, incoming_);
}

void VertexExchange::pack_held(std::span<const double> values, std::size_t width) {
  for (Link& link : links_) {
    link.message.clear();
    for (const int h : link.held_here) {
      append(link.message, values.subspan(width * static_cast<std::size_t>(h), width));
    }
  }
}

void VertexExchange::unpack_held(std::size_t width, std::span<double> returned) const {
  for (const Incoming& message : incoming_) {
    const Link& link = links_[static_cast<std::size_t>(message.source)];
    const std::size_t bytes = width * sizeof(double);
    if (message.bytes.size() < bytes * link.held_there.size()) {
      require_length(message.bytes.size(), bytes * link.held_there.size(), message.source);
    }
    for (std::size_t i = 0; i < link.held_there.size(); ++i) {
      const auto vertex = static_cast<std::size_t>(link.held_there[i]);
      std::memcpy(&returned[width * vertex], message.bytes.data() + bytes * i, bytes);
    }
  }
}

void VertexExchange::return_to_owners(std::span<const double> values, int components, std::span<double> returned) {
  if (communicator_.size() == 1) {
    std::copy(values.begin(), values.end(), returned.begin());
    return;
  }
  const auto width = static_cast<std::size_t>(components);
  pack_held(values, width);
  exchange_messages();
  unpack_held(width, returned);
}

void VertexExchange::return_to_owners(std::span<const double> values, int components, std::span<double> returned,
                                      std::span<const ContactLoad> loads, std::span<ContactLoad> own_loads) {
  if (communicator_.size() == 1) {
    std::copy(values.begin(), values.end(), returned.begin());
    std::copy(loads.begin(), loads.end(), own_loads.begin());
    return;
  }
  const auto width = static_cast<std::size_t>(components);
  pack_held(values, width);
  for (Link& link : links_) {
    for (std::size_t i = 0; i < link.around.size(); ++i) {
      const LoadRecord record{static_cast<std::int64_t>(i), loads[static_cast<std::size_t>(link.around[i])]};
      if (!record.load.is_zero()) append(link.message, std::span(&record, 1));
    }
  }
  exchange_messages();
  unpack_held(width, returned);
  std::fill(own_loads.begin(), own_loads.end(), ContactLoad{});
  for (const Incoming& message : incoming_) {
    const Link& link = links_[static_cast<std::size_t>(message.source)];
    std::size_t at = width * sizeof(double) * link.held_there.size();
    for (; at < message.bytes.size(); at += sizeof(LoadRecord)) {
      LoadRecord record;
      std::memcpy(&record, message.bytes.data() + at, sizeof record);
      own_loads[static_cast<std::size_t>(link.sent[static_cast<std::size_t>(record.vertex)])].add(record.load);
    }
    require_length(message.bytes.size(), at, message.source);
  }
}

void VertexExchange::share_forces(std::span<const double> forces, std::vector<double>& arrived) {
  if (communicator_.size() == 1) {
    arrived.assign(forces.begin(), forces.end());
    return;
  }
  for (Link& link : links_) {
    link.message.clear();
    for (const int v : link.sent_near) append(link.message, forces.subspan(3 * static_cast<std::size_t>(v), 3));
  }
  exchange_messages();
  arrived.resize(3 * known_.id.size());
  for (const Incoming& message : incoming_) {
    const Link& link = links_[static_cast<std::size_t>(message.source)];
    constexpr std::size_t bytes = 3 * sizeof(double);
    require_length(message.bytes.size(), bytes * link.known.size(), message.source);
    for (std::size_t i = 0; i < link.known.size(); ++i) {
      std::memcpy(&arrived[3 * static_cast<std::size_t>(link.known[i])], message.bytes.data() + bytes * i, bytes);
    }
  }
}

}  // namespace npfem::flow
