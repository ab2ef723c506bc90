// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "contact/repulsion.h"
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
  /// locate(), wherever the vertices move meanwhile: velocity and force meet at the same place.
  void locate(const CellPopulation& cells);

  /// Velocity of the fluid at the vertices, with half of the force held by the lattice.
  void sample_velocity(std::vector<double>& velocity);
  /// Repulsion between cells and from walls.
  void sample_contact(std::vector<double>& contact);
  /// Both, in one message per pair of ranks.
  void sample(std::vector<double>& velocity, std::vector<double>& contact);

  /// Makes the lattice hold the body force and these forces from now on.
  void apply(std::span<const double> forces);

  /// This rank's share of what came from outside the suspension with the last sample and apply: repulsion of walls less
  /// the force spread on solid nodes. Lattice units.
  Vec3 external_force() const;

  /// Seconds this rank has spent here: in messages between ranks and in the transfer itself.
  double seconds() const { return seconds_; }

 private:
  std::size_t held_count() const { return exchange_.known().held.size(); }
  void interpolate();
  void find_contact();

  Units units_;
  Lattice& lattice_;
  VertexExchange exchange_;
  ImmersedBoundary boundary_;
  Repulsion repulsion_;
  bool has_walls_;

  std::vector<double> positions_;      // own vertices, um
  std::vector<double> held_velocity_;  // held vertices, um/us
  std::vector<double> held_contact_;   // held vertices, pN
  std::vector<double> held_both_, own_both_;
  std::vector<double> known_force_;  // known vertices, lattice units
  std::size_t own_vertices_ = 0;
  Vec3 force_on_walls_{};  // lattice units
  double seconds_ = 0;
};

}  // namespace npfem::flow
