// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "contact/contact_vertices.h"
#include "contact/fixed_point.h"

namespace npfem::flow {

/// The vertices one rank has to know for the fluid: all those within two nodes of its own block, whoever owns their
/// cells. That is as far as the widest kernel reaches. In order of (cell, vertex), as every sum over them is.
struct KnownVertices {
  std::vector<VertexId> id;
  std::vector<double> position;  ///< xyz, um, unwrapped
  std::vector<double> in_nodes;  ///< the same in node spacings
  /// The vertices whose node (node_in_grid) this rank holds, as ascending indices into the arrays above. Each vertex of
  /// the system is held by exactly one rank, which interpolates there and finds its contact forces.
  std::vector<int> held;
};

/// Carries vertex data between the rank that owns a cell (where its centroid is) and the ranks whose nodes its vertices
/// touch or whose contacts they find, in three phases of one packed message per pair of ranks:
///   1  share_positions    owner -> every rank that must know the vertex
///   2  return_to_owners   the rank that holds the vertex, or has found a contact of it -> owner
///   3  share_forces       owner -> every rank that must know the vertex
/// Owners give and get their vertices as one array in order of (cell, vertex). All calls are collective.
class VertexExchange {
 public:
  VertexExchange(Communicator& communicator, const Decomposition& decomposition, double dx);

  /// Positions in um, xyz per id: where the vertices are, and where they are expected when contacts act. Every rank
  /// gets to know for its contacts all vertices within `contact_reach` nodes of its block (at least two).
  void share_positions(std::span<const VertexId> ids, std::span<const double> positions,
                       std::span<const double> expected, int contact_reach);
  const KnownVertices& known() const { return known_; }
  const ContactVertices& contact_vertices() const { return contact_vertices_; }

  /// `values`: `components` numbers per entry of known().held. `returned`: as many per own vertex, overwritten.
  void return_to_owners(std::span<const double> values, int components, std::span<double> returned);
  /// The same, and in the same messages the contact loads found here, one per entry of contact_vertices(). `own_loads`:
  /// their sums over all ranks, one per own vertex, overwritten.
  void return_to_owners(std::span<const double> values, int components, std::span<double> returned,
                        std::span<const ContactLoad> loads, std::span<ContactLoad> own_loads);

  /// `forces`: xyz per own vertex. `arrived`: resized to xyz per known vertex, in the order of known().
  void share_forces(std::span<const double> forces, std::vector<double>& arrived);

 private:
  struct Record {
    VertexId id;
    double position[3], expected[3];
  };
  // A contact load on its way to the owner of the vertex.
  struct LoadRecord {
    std::int64_t vertex;  // place in Link::sent
    ContactLoad load;
  };
  // What passes between this rank and one other.
  struct Link {
    std::vector<int> sent;        // own vertices that the other rank must know,
    std::vector<int> sent_near;   // those of them that its fluid feels, and
    std::vector<int> held_there;  // those that it holds
    std::vector<int> around;      // vertices that the other rank owns, in the order of its message, for contacts,
    std::vector<int> known;       // those of them that the fluid here feels, as indices into known(), and
    std::vector<int> held_here;   // those that are held here, as indices into known().held
    std::vector<Record> records;  // outgoing messages
    Bytes message;
  };
  // Consecutive vertices of one cell in the message of one rank.
  struct Run {
    int cell;
    std::size_t message;
    std::size_t first, count;
  };
  // By axis and node: one node of each block that comes within some nodes of it.
  using BlocksNear = std::array<std::vector<std::vector<int>>, 3>;

  BlocksNear blocks_within(int reach) const;
  template <class Visit>
  void for_each_rank_near(const BlocksNear& near, const Index3& node, Visit&& visit) const;
  void know_own(std::span<const VertexId> ids, std::span<const double> positions, std::span<const double> expected);
  void plan(std::span<const double> positions);
  void unpack_positions();
  void place(const Run& run, std::size_t at);
  void take_known(const Record& record, int place, Link& link);
  bool fluid_feels(const Index3& node) const;
  void exchange_messages();
  void pack_held(std::span<const double> values, std::size_t width);
  void unpack_held(std::size_t width, std::span<double> returned) const;

  Communicator& communicator_;
  Decomposition decomposition_;
  double dx_;
  Box own_;
  BlocksNear near_fluid_, near_contact_;
  int contact_reach_ = 0;
  std::array<std::vector<char>, 3> feels_;  // by axis and node: own block comes within two nodes of it

  std::vector<Link> links_;  // by rank
  KnownVertices known_;
  ContactVertices contact_vertices_;
  std::vector<Run> runs_;
  std::vector<Outgoing> outgoing_;
  std::vector<Incoming> incoming_;
};

}  // namespace npfem::flow
