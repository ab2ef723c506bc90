// SPDX-License-Identifier: MPL-2.0
#pragma once

// What one rank and another, or the two sides of a periodic box, have to tell each other about nodes on both sides of a
// face, edge or corner. Each pair of ranks passes one packed message a phase, in an order that both know beforehand.

#include <cstddef>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "lattice/kernels.h"
#include "lattice/node_map.h"

namespace npfem::flow {

// One outgoing and one incoming message per peer, of lengths that both sides know.
struct PackedMessages {
  std::vector<Bytes> sent, received;
  std::vector<Outgoing> outgoing;
  std::vector<Expected> expected;
};

// Populations that cross from the nodes of one rank to those of another. Of each pair of neighbouring fluid nodes x and
// x + c_i that belong to different ranks, the rank of x stores the population that goes up in its copy of x + c_i,
// while the one that comes down lies with the rank of x + c_i (kernels.h): after a step each sends the other one
// number.
class PopulationExchange {
 public:
  PopulationExchange(Communicator& communicator, const Decomposition& decomposition, const NodeMap& nodes);

  // start() when all nodes next to other ranks have been updated, finish() when all nodes have. Collective.
  template <class Real>
  void start(const FluidFields<Real>& fields);
  template <class Real>
  void finish(const FluidFields<Real>& fields);

 private:
  // Indices of the near place in even steps, at the node x + c_i, for the links whose lower node x, or whose upper node
  // x + c_i, is this rank's; in the order of the lower nodes' global ids and of directions.
  struct Peer {
    int rank;
    std::vector<std::ptrdiff_t> lower_mine, upper_mine;
  };
  struct OwnPair {
    std::ptrdiff_t copy, own;  // the place at x + c_i as seen from x, and as its own
  };

  Communicator& communicator_;
  std::vector<Peer> peers_;
  std::vector<OwnPair> own_pairs_;  // across a periodic direction that is not cut
  PackedMessages messages_;
};

// Three numbers a node that its owner knows and others need: the halo of the velocity.
class VectorExchange {
 public:
  VectorExchange(Communicator& communicator, const Decomposition& decomposition, const NodeMap& nodes);

  // Fills the fluid nodes of the halo from their owners. Collective.
  template <class Real>
  void fill_halo(Real* vectors);

 private:
  struct Peer {
    int rank;
    std::vector<NodeNumber> sent, received;  // both ranks list them in the same order
  };
  struct OwnPair {
    NodeNumber copy, own;
  };

  Communicator& communicator_;
  std::vector<Peer> peers_;
  std::vector<OwnPair> own_pairs_;
  PackedMessages messages_;
};

}  // namespace npfem::flow
