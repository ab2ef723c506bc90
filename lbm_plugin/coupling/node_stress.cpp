// SPDX-License-Identifier: MPL-2.0
#include "coupling/node_stress.h"

#include <cstring>

namespace npfem::flow {
namespace {

template <class T>
std::vector<Outgoing> messages_of(const std::vector<std::vector<T>>& by_rank) {
  std::vector<Outgoing> outgoing;
  for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
    if (!by_rank[rank].empty()) outgoing.push_back({static_cast<int>(rank), std::as_bytes(std::span(by_rank[rank]))});
  }
  return outgoing;
}

template <class T>
std::vector<T> records_in(const Bytes& bytes) {
  std::vector<T> records(bytes.size() / sizeof(T));
  std::memcpy(records.data(), bytes.data(), records.size() * sizeof(T));
  return records;
}

NodeStress own_stress(const Lattice& lattice, const Index3& node) {
  const Index3& first = lattice.nodes().own().begin;
  const int ix = node[0] - first[0], iy = node[1] - first[1], iz = node[2] - first[2];
  NodeStress stress{lattice.density_deviation(ix, iy, iz) / 3, lattice.strain_rate(ix, iy, iz)};
  for (double& component : stress.viscous) component *= 2 * lattice.viscosity();
  return stress;
}

}  // namespace

std::vector<NodeStress> stresses_at(std::span<const Index3> nodes, const Lattice& lattice, Communicator& communicator) {
  const auto ranks = static_cast<std::size_t>(communicator.size());
  std::vector<std::vector<Index3>> asked(ranks);
  std::vector<std::vector<std::size_t>> asked_for(ranks);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] == kNoSuchNode) continue;
    const auto holder =
        static_cast<std::size_t>(lattice.decomposition().owner_of(nodes[i][0], nodes[i][1], nodes[i][2]));
    asked[holder].push_back(nodes[i]);
    asked_for[holder].push_back(i);
  }
  std::vector<Incoming> incoming;
  communicator.exchange(messages_of(asked), incoming);

  std::vector<std::vector<NodeStress>> answers(ranks);
  for (const Incoming& question : incoming) {
    for (const Index3& node : records_in<Index3>(question.bytes)) {
      answers[static_cast<std::size_t>(question.source)].push_back(own_stress(lattice, node));
    }
  }
  communicator.exchange(messages_of(answers), incoming);

  std::vector<NodeStress> stresses(nodes.size());
  for (const Incoming& answer : incoming) {
    const std::vector<NodeStress> found = records_in<NodeStress>(answer.bytes);
    const std::vector<std::size_t>& places = asked_for[static_cast<std::size_t>(answer.source)];
    for (std::size_t i = 0; i < found.size(); ++i) stresses[places[i]] = found[i];
  }
  return stresses;
}

}  // namespace npfem::flow
