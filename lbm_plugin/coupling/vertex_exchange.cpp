// SPDX-License-Identifier: MPL-2.0
#include "coupling/vertex_exchange.h"

#include <algorithm>
#include <cstring>
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
      links_(static_cast<std::size_t>(communicator.size())) {
  find_blocks_near();
}

void VertexExchange::find_blocks_near() {
  for (int axis = 0; axis < 3; ++axis) {
    const auto block_of = [&](int node) {
      Index3 probe{};
      probe[static_cast<std::size_t>(axis)] = node;
      return decomposition_.owner_of(probe[0], probe[1], probe[2]);
    };
    auto& table = blocks_near_[static_cast<std::size_t>(axis)];
    table.resize(static_cast<std::size_t>(decomposition_.nodes()[static_cast<std::size_t>(axis)]));
    for (int node = 0; node < static_cast<int>(table.size()); ++node) {
      auto& near = table[static_cast<std::size_t>(node)];
      for (int other = node - Lattice::kHalo; other <= node + Lattice::kHalo; ++other) {
        const int there = node_in_grid(decomposition_, axis, other);
        const bool seen = std::any_of(near.begin(), near.end(), [&](int n) { return block_of(n) == block_of(there); });
        if (!seen) near.push_back(there);
      }
    }
  }
}

void VertexExchange::share_positions(std::span<const VertexId> ids, std::span<const double> positions) {
  plan(positions);
  outgoing_.clear();
  for (std::size_t rank = 0; rank < links_.size(); ++rank) {
    Link& link = links_[rank];
    link.records.clear();
    for (const int v : link.sent) {
      const auto i = static_cast<std::size_t>(v);
      link.records.push_back({ids[i], {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}});
    }
    if (!link.records.empty()) outgoing_.push_back({static_cast<int>(rank), std::as_bytes(std::span(link.records))});
  }
  communicator_.exchange(outgoing_, incoming_);
  unpack_positions();
  find_held();
}

void VertexExchange::plan(std::span<const double> positions) {
  for (Link& link : links_) {
    link.sent.clear();
    link.held_there.clear();
  }
  for (std::size_t v = 0; v < positions.size() / 3; ++v) {
    const Index3 node = node_in_grid(decomposition_, in_nodes(positions, v, dx_));
    const int holder = decomposition_.owner_of(node[0], node[1], node[2]);
    links_[static_cast<std::size_t>(holder)].held_there.push_back(static_cast<int>(v));
    for (const int z : blocks_near_[2][static_cast<std::size_t>(node[2])]) {
      for (const int y : blocks_near_[1][static_cast<std::size_t>(node[1])]) {
        for (const int x : blocks_near_[0][static_cast<std::size_t>(node[0])]) {
          const int rank = decomposition_.owner_of(x, y, z);
          links_[static_cast<std::size_t>(rank)].sent.push_back(static_cast<int>(v));
        }
      }
    }
  }
}

/// Merges the messages by cell. One rank owns a cell and sends its vertices in order, so whole runs are moved.
void VertexExchange::unpack_positions() {
  for (Link& link : links_) link.known.clear();
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
    links_[static_cast<std::size_t>(incoming_[m].source)].known.resize(count);
    total += count;
  }
  std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.cell < b.cell; });

  known_.id.resize(total);
  known_.position.resize(3 * total);
  known_.in_nodes.resize(3 * total);
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
    known_.id[k] = record.id;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      known_.position[3 * k + axis] = record.position[axis];
      known_.in_nodes[3 * k + axis] = record.position[axis] / dx_;
    }
    link.known[run.first + i] = static_cast<int>(k);
  }
}

void VertexExchange::find_held() {
  known_.held.clear();
  place_in_held_.assign(known_.id.size(), -1);
  for (std::size_t k = 0; k < known_.id.size(); ++k) {
    const Vec3 position{known_.in_nodes[3 * k], known_.in_nodes[3 * k + 1], known_.in_nodes[3 * k + 2]};
    const Index3 node = node_in_grid(decomposition_, position);
    if (!own_.contains(node[0], node[1], node[2])) continue;
    place_in_held_[k] = static_cast<int>(known_.held.size());
    known_.held.push_back(static_cast<int>(k));
  }
  for (Link& link : links_) {
    link.held_here.clear();
    for (const int k : link.known) {
      const int place = place_in_held_[static_cast<std::size_t>(k)];
      if (place >= 0) link.held_here.push_back(place);
    }
  }
}

void VertexExchange::exchange_numbers() {
  outgoing_.clear();
  for (std::size_t rank = 0; rank < links_.size(); ++rank) {
    const auto& numbers = links_[rank].numbers;
    if (!numbers.empty()) outgoing_.push_back({static_cast<int>(rank), std::as_bytes(std::span(numbers))});
  }
  communicator_.exchange(outgoing_, incoming_);
}

void VertexExchange::return_to_owners(std::span<const double> values, int components, std::span<double> returned) {
  const auto width = static_cast<std::size_t>(components);
  for (Link& link : links_) {
    link.numbers.clear();
    for (const int h : link.held_here) {
      const auto first = values.subspan(width * static_cast<std::size_t>(h), width);
      link.numbers.insert(link.numbers.end(), first.begin(), first.end());
    }
  }
  exchange_numbers();
  for (const Incoming& message : incoming_) {
    const Link& link = links_[static_cast<std::size_t>(message.source)];
    const std::size_t bytes = width * sizeof(double);
    require_length(message.bytes.size(), bytes * link.held_there.size(), message.source);
    for (std::size_t i = 0; i < link.held_there.size(); ++i) {
      const auto vertex = static_cast<std::size_t>(link.held_there[i]);
      std::memcpy(&returned[width * vertex], message.bytes.data() + bytes * i, bytes);
    }
  }
}

void VertexExchange::share_forces(std::span<const double> forces, std::vector<double>& arrived) {
  for (Link& link : links_) {
    link.numbers.clear();
    for (const int v : link.sent) {
      const auto first = forces.subspan(3 * static_cast<std::size_t>(v), 3);
      link.numbers.insert(link.numbers.end(), first.begin(), first.end());
    }
  }
  exchange_numbers();
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
