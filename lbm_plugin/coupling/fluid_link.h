// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "contact/contacts.h"
#include "coupling/fluid.h"
#include "coupling/momentum_audit.h"
#include "coupling/surface_inset.h"
#include "coupling/vertex_exchange.h"
#include "immersed_boundary/immersed_boundary.h"
#include "lattice/lattice.h"
#include "simulation/setup.h"
#include "units.h"

namespace npfem::flow {

/// The lattice as the fluid of a coupling, across all ranks: what the vertices of the solid and the nodes of the fluid
/// have to say to each other, and the contacts of the vertices. Where contacts act, the bodies are the cells of the
/// setup.
class FluidLink final : public Fluid {
 public:
  /// All outlive the link. `audit` books the forces and steps of the lattice.
  FluidLink(const Setup& setup, const Units& units, Communicator& communicator, Lattice& lattice, MomentumAudit& audit);

  std::vector<double> ambient_masses(std::span<const double> rest_areas, double delta) const override;
  void locate(const ImmersedSolid& solid, double delta) override;
  void sample_velocity(std::span<double> velocity) override;
  void sample_contact(std::span<double> contact) override;
  /// In one message per pair of ranks.
  void sample(std::span<double> velocity, std::span<double> contact, std::span<double> stiffness) override;
  /// The lattice holds the body force beside these.
  void hold(std::span<const double> forces, const Vec3& outside) override;
  void step() override;

  /// What only the lineage's coupling asks. Other positions of the vertices (um), contacts left out:
  void locate_at(const ImmersedSolid& solid, std::span<const double> positions);
  /// One number per vertex, 1 where another cell or a wall is within one node (crowding.h), else 0.
  void sample_crowding(std::span<double> crowded);

  /// Of the contacts between cells that this rank has found so far, um; infinite where there was none.
  double least_contact_distance() const { return least_contact_distance_; }

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
  int contact_reach(const ImmersedSolid& solid, double delta);
  void interpolate();
  void find_contacts();
  void take_forces(std::span<double> contact) const;
  void spread(std::span<const double> forces);
  Vec3 external_force() const;

  Units units_;
  Lattice& lattice_;
  VertexExchange exchange_;
  ImmersedBoundary boundary_;
  SurfaceInset inset_;
  Contacts contacts_;
  const Setup& setup_;
  bool has_walls_;
  Communicator& communicator_;
  MomentumAudit& audit_;

  std::vector<double> positions_, velocities_, expected_;  // own vertices, um, um/us
  std::vector<double> at_markers_;                         // forces of own vertices, pN
  std::vector<double> held_velocity_;                      // held vertices, um/us
  std::vector<ContactLoad> found_, own_;                   // vertices around, own vertices
  std::vector<double> known_force_;                        // known vertices, lattice units
  std::size_t own_vertices_ = 0;
  Vec3 force_on_walls_{};  // lattice units
  double least_contact_distance_ = std::numeric_limits<double>::infinity();
  Seconds seconds_;
};

}  // namespace npfem::flow
