// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"

namespace npfem::flow {

/// A vertex of a cell, by the global id of the cell.
struct VertexId {
  int cell;
  int vertex;
};

/// The vertices one rank has to know: all those within two nodes of its own block, whoever owns their cells. That is as
/// far as the widest kernel reaches and as far as contacts may. In order of (cell, vertex), as every sum over them is.
struct KnownVertices {
  std::vector<VertexId> id;
  std::vector<double> position;  ///< xyz, um, unwrapped
  std::vector<double> in_nodes;  ///< the same in node spacings
  /// The vertices whose node (node_in_grid) this rank holds, as ascending indices into the arrays above. Each vertex of
  /// the system is held by exactly one rank, which interpolates there and finds its contact forces.
  std::vector<int> held;
};

/// Carries vertex data between the rank that owns a cell (where its centroid is) and the ranks whose nodes its vertices
/// touch, in three phases of one packed message per pair of ranks:
///   1  share_positions    owner -> every rank that must know the vertex
///   2  return_to_owners   the rank that holds the vertex -> owner
///   3  share_forces       owner -> every rank that must know the vertex
/// Owners give and get their vertices as one array in order of (cell, vertex). All calls are collective.
class VertexExchange {
 public:
  VertexExchange(Communicator& communicator, const Decomposition& decomposition, double dx);

  /// Positions in um, xyz per id.
  void share_positions(std::span<const VertexId> ids, std::span<const double> positions);
  const KnownVertices& known() const { return known_; }

  /// `values`: `components` numbers per entry of known().held. `returned`: as many per own vertex, overwritten.
  void return_to_owners(std::span<const double> values, int components, std::span<double> returned);

  /// `forces`: xyz per own vertex. `arrived`: resized to xyz per known vertex, in the order of known().
  void share_forces(std::span<const double> forces, std::vector<double>& arrived);

 private:
  struct Record {
    VertexId id;
    double position[3];
  };
  // What passes between this rank and one other.
  struct Link {
    std::vector<int> sent;        // own vertices that the other rank must know, and
    std::vector<int> held_there;  // those of them that it holds
    std::vector<int> known;       // known vertices that the other rank owns, in the order of its message, and
    std::vector<int> held_here;   // those of them that are held here, as indices into known().held
    std::vector<Record> records;  // outgoing messages
    std::vector<double> numbers;
  };
  // Consecutive vertices of one cell in the message of one rank.
  struct Run {
    int cell;
    std::size_t message;
    std::size_t first, count;
  };

  void find_blocks_near();
  void plan(std::span<const double> positions);
  void unpack_positions();
  void place(const Run& run, std::size_t at);
  void find_held();
  void exchange_numbers();

  Communicator& communicator_;
  Decomposition decomposition_;
  double dx_;
  Box own_;
  // By axis and node: one node of each block that comes within two nodes of it.
  std::array<std::vector<std::vector<int>>, 3> blocks_near_;

  std::vector<Link> links_;  // by rank
  KnownVertices known_;
  std::vector<int> place_in_held_;  // by known vertex, -1 where another rank holds it
  std::vector<Run> runs_;
  std::vector<Outgoing> outgoing_;
  std::vector<Incoming> incoming_;
};

}  // namespace npfem::flow
