// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "contact/contacts.h"
#include "coupling/cell_population.h"
#include "coupling/vertex_exchange.h"
#include "immersed_boundary/immersed_boundary.h"
#include "lattice/lattice.h"
#include "simulation/setup.h"
#include "units.h"

namespace npfem::flow {

/// What the vertices of the cells and the nodes of the fluid have to say to each other, across all ranks. Vertex data
/// are those of the own cells, xyz per vertex in the order of CellPopulation::vertices(), in um, us, pN. All calls are
/// collective.
class FluidLink {
 public:
  FluidLink(const Setup& setup, const Units& units, Communicator& communicator, Lattice& lattice);

  /// Finds the nodes around the vertices at their present positions. The calls below use these positions until the next
  /// locate(), wherever the vertices move meanwhile: velocity and force meet at the same place. Contacts act where the
  /// vertices would be after `delta` (us) at their present velocities.
  void locate(const CellPopulation& cells, double delta);

  /// The same at other positions of the vertices (um), contacts left out.
  void locate_at(const CellPopulation& cells, std::span<const double> positions);

  /// Velocity of the fluid at the vertices, with half of the force held by the lattice.
  void sample_velocity(std::vector<double>& velocity);
  /// Forces of contacts between cells and with walls.
  void sample_contact(std::vector<double>& contact);
  /// One number per vertex, 1 where another cell or a wall is within one node (crowding.h), else 0.
  void sample_crowding(std::vector<double>& crowded);
  /// Velocities and contacts in one message per pair of ranks, and the stiffness of the contacts, one number per
  /// vertex, pN/um.
  void sample(std::vector<double>& velocity, std::vector<double>& contact, std::vector<double>& stiffness);

  /// Makes the lattice hold the body force and these forces from now on.
  void apply(std::span<const double> forces);

  /// This rank's share of what came from outside the suspension with the last sample and apply: contact with walls less
  /// the force spread on solid nodes. Lattice units.
  Vec3 external_force() const;

  /// What this rank has spent here.
  struct Seconds {
    double velocity = 0;       ///< velocity field of the lattice and its halo
    double interpolation = 0;  ///< from nodes to vertices
    double spreading = 0;      ///< from vertices to nodes
    double contacts = 0;       ///< search and forces
    double exchange = 0;       ///< vertices between ranks, reading and packing them
    double all() const { return velocity + interpolation + spreading + contacts + exchange; }
  };
  const Seconds& seconds() const { return seconds_; }

 private:
  std::size_t held_count() const { return exchange_.known().held.size(); }
  int contact_reach(const CellPopulation& cells, double delta);
  void interpolate();
  void find_contacts();
  void take_forces(std::vector<double>& contact) const;

  Units units_;
  Lattice& lattice_;
  VertexExchange exchange_;
  ImmersedBoundary boundary_;
  Contacts contacts_;
  const Domain& domain_;
  const std::vector<CellType>& types_;
  bool has_walls_;
  Communicator& communicator_;

  std::vector<double> positions_, velocities_, expected_;  // own vertices, um, um/us
  std::vector<double> held_velocity_;                      // held vertices, um/us
  std::vector<ContactLoad> found_, own_;                   // vertices around, own vertices
  std::vector<double> known_force_;                        // known vertices, lattice units
  std::size_t own_vertices_ = 0;
  Vec3 force_on_walls_{};  // lattice units
  Seconds seconds_;
};

}  // namespace npfem::flow
