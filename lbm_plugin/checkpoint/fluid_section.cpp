// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/fluid_section.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace npfem::flow {
namespace {

constexpr std::size_t populations = d3q19::kDirections;
constexpr std::size_t node_words = 1 + populations + 3;  // global id, populations, force
constexpr std::int64_t nodes_at_once = 1 << 15;          // of one rank, 6 MB

using NodeRecord = std::array<Word, node_words>;

NodeRecord record_of(const Lattice& lattice, std::int64_t id, const Index3& at) {
  NodeRecord record{static_cast<Word>(id)};
  const Lattice::Populations values = lattice.populations_at(at[0], at[1], at[2]);
  const Vec3 force = lattice.force_at(at[0], at[1], at[2]);
  for (std::size_t i = 0; i < populations; ++i) record[1 + i] = std::bit_cast<Word>(values[i]);
  for (std::size_t i = 0; i < 3; ++i) record[1 + populations + i] = std::bit_cast<Word>(force[i]);
  return record;
}

/// The own fluid nodes of a lattice, in order of global ids.
class NodeCursor {
 public:
  explicit NodeCursor(const Lattice& lattice) : lattice_(lattice) { skip_solid(); }

  bool done() const { return at_[2] == lattice_.nodes().size(2); }
  const Index3& at() const { return at_; }
  std::int64_t id() const {
    const Index3& first = lattice_.nodes().own().begin;
    return lattice_.decomposition().global_id(first[0] + at_[0], first[1] + at_[1], first[2] + at_[2]);
  }
  void advance() {
    next();
    skip_solid();
  }

 private:
  void next() {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (++at_[a] < lattice_.nodes().size(axis) || axis == 2) return;
      at_[a] = 0;
    }
  }
  void skip_solid() {
    while (!done() && lattice_.node_type(at_[0], at_[1], at_[2]) != kFluid) next();
  }

  const Lattice& lattice_;
  Index3 at_{};
};

using Mail = std::vector<std::vector<NodeRecord>>;  // by destination

std::vector<NodeRecord> deliver(Communicator& communicator, const Mail& mail) {
  std::vector<Outgoing> outgoing;
  for (std::size_t rank = 0; rank < mail.size(); ++rank) {
    if (!mail[rank].empty()) outgoing.push_back({static_cast<int>(rank), std::as_bytes(std::span(mail[rank]))});
  }
  std::vector<Incoming> incoming;
  communicator.exchange(outgoing, incoming);
  std::vector<NodeRecord> records;
  for (const Incoming& message : incoming) {
    const std::size_t begin = records.size();
    records.resize(begin + message.bytes.size() / sizeof(NodeRecord));
    std::memcpy(records.data() + begin, message.bytes.data(), message.bytes.size());
  }
  return records;
}

std::span<const Word> words_of(const std::vector<NodeRecord>& records) {
  return {records.empty() ? nullptr : records.front().data(), records.size() * node_words};
}

std::vector<NodeRecord> read_nodes(CheckpointFile& file, std::int64_t first, std::int64_t count) {
  std::vector<NodeRecord> records(static_cast<std::size_t>(count));
  if (count > 0) {
    file.read("fluid", first * static_cast<std::int64_t>(node_words),
              {records.front().data(), records.size() * node_words});
  }
  return records;
}

/// False for a node that is not fluid here.
bool set_node(Lattice& lattice, const NodeRecord& record) {
  const Index3 nodes = lattice.decomposition().nodes();
  const Index3& first = lattice.nodes().own().begin;
  const auto id = static_cast<std::int64_t>(record[0]);
  const int ix = static_cast<int>(id % nodes[0]) - first[0];
  const int iy = static_cast<int>(id / nodes[0] % nodes[1]) - first[1];
  const int iz = static_cast<int>(id / nodes[0] / nodes[1]) - first[2];
  if (lattice.node_type(ix, iy, iz) != kFluid) return false;
  Lattice::Populations values;
  Vec3 force;
  for (std::size_t i = 0; i < populations; ++i) values[i] = std::bit_cast<double>(record[1 + i]);
  for (std::size_t i = 0; i < 3; ++i) force[i] = std::bit_cast<double>(record[1 + populations + i]);
  lattice.set_populations_at(ix, iy, iz, values);
  lattice.set_force_at(ix, iy, iz, force);
  return true;
}

int owner_of(const Decomposition& grid, std::int64_t id) {
  const Index3 nodes = grid.nodes();
  return grid.owner_of(static_cast<int>(id % nodes[0]), static_cast<int>(id / nodes[0] % nodes[1]),
                       static_cast<int>(id / nodes[0] / nodes[1]));
}

}  // namespace

void save_fluid(const Lattice& lattice, Communicator& communicator, CheckpointWriter& file) {
  const Index3 nodes = lattice.decomposition().nodes();
  const std::int64_t all = std::int64_t{nodes[0]} * nodes[1] * nodes[2];
  const auto ranks = static_cast<std::size_t>(communicator.size());
  NodeCursor cursor(lattice);
  std::int64_t written = 0;  // nodes, by all ranks
  file.begin_section("fluid");
  // The ids are dealt out in rounds: nodes_at_once to each rank.
  for (std::int64_t begin = 0; begin < all; begin += nodes_at_once * communicator.size()) {
    Mail mail(ranks);
    for (; !cursor.done() && cursor.id() < begin + nodes_at_once * communicator.size(); cursor.advance()) {
      const auto writer = static_cast<std::size_t>((cursor.id() - begin) / nodes_at_once);
      mail[writer].push_back(record_of(lattice, cursor.id(), cursor.at()));
    }
    std::vector<NodeRecord> records = deliver(communicator, mail);
    std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
    std::int64_t count = std::ssize(records);
    const std::int64_t first = written + communicator.exclusive_scan(count);
    const CheckpointWriter::Piece piece{first * static_cast<std::int64_t>(node_words), words_of(records)};
    file.write(std::span(&piece, 1));
    communicator.sum(std::span(&count, 1));
    written += count;
  }
  file.end_section();
}

void load_fluid(Lattice& lattice, Communicator& communicator, CheckpointFile& file) {
  const Index3 nodes = lattice.decomposition().nodes();
  const std::int64_t all = std::int64_t{nodes[0]} * nodes[1] * nodes[2];
  const std::int64_t saved = file.words("fluid") / static_cast<std::int64_t>(node_words);
  std::int64_t next = saved * communicator.rank() / communicator.size();
  const std::int64_t end = saved * (communicator.rank() + 1) / communicator.size();
  std::int64_t found = 0;
  bool same = true;
  std::string failure;
  while (communicator.any(next < end && failure.empty())) {
    Mail mail(static_cast<std::size_t>(communicator.size()));
    try {
      const std::int64_t count = failure.empty() ? std::min(nodes_at_once, end - next) : 0;
      for (const NodeRecord& record : read_nodes(file, next, count)) {
        const auto id = static_cast<std::int64_t>(record[0]);
        same = same && id >= 0 && id < all;
        if (same) mail[static_cast<std::size_t>(owner_of(lattice.decomposition(), id))].push_back(record);
      }
      next += count;
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
    for (const NodeRecord& record : deliver(communicator, mail)) {
      same = set_node(lattice, record) && same;
      ++found;
    }
  }
  same = same && found == lattice.nodes().fluid_nodes();
  if (failure.empty() && !same) {
    failure = file.path().string() + ": its fluid nodes are not those of the scene: the geometry is another one";
  }
  communicator.agree(failure);
}

}  // namespace npfem::flow
