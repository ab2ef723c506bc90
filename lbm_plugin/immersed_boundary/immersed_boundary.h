// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <span>

#include "immersed_boundary/stencil.h"
#include "lattice/lattice.h"

namespace npfem::flow {

/// The immersed boundary of one rank: velocities from the nodes to the vertices (interpolation) and forces from the
/// vertices to the nodes (spreading), with the same weights both ways. The two are therefore adjoint: the power of the
/// vertex forces at the interpolated velocities equals the power of the node forces at the node velocities, so the
/// coupling itself neither makes nor destroys energy.
///
/// At a wall the weights stay as they are and solid nodes take part: they carry the velocity of the wall, and the force
/// spread on them is borne by the wall. A vertex thus loses its slip as it comes near a wall, the pair stays adjoint,
/// and force_on_walls() says what the wall has borne. (Weights renormalised over the fluid nodes would keep all the
/// force in the fluid, but let a vertex slide along a wall, and into it, at the speed of the nodes above.)
///
/// Positions in node spacings, forces and velocities in lattice units, all arrays xyzxyz...
class ImmersedBoundary {
 public:
  /// kernel_points: 2, 3 or 4. std::invalid_argument otherwise.
  ImmersedBoundary(int kernel_points, const Decomposition& decomposition, int rank);

  /// Velocity at positions[3 v] for every v of `held`, the vertices whose node this rank holds; after
  /// Lattice::update_velocity(). velocities[3 i] belongs to held[i].
  void interpolate(const Lattice& lattice, std::span<const double> positions, std::span<const int> held,
                   std::span<double> velocities) const;

  /// Adds the forces to the own nodes of this rank, vertex after vertex in the order given.
  void spread(Lattice& lattice, std::span<const double> positions, std::span<const double> forces) const;

  /// The part of the forces at the vertices `held` that solid nodes take.
  Vec3 force_on_walls(const Lattice& lattice, std::span<const double> positions, std::span<const int> held,
                      std::span<const double> forces) const;

 private:
  template <int Points>
  using LocalNodes = std::array<std::array<int, Points>, 3>;

  template <int Points>
  LocalNodes<Points> nodes_to_read(const Vec3& position, const Stencil<Points>& stencil) const;
  template <int Points>
  bool nodes_to_write(const Stencil<Points>& stencil, LocalNodes<Points>& nodes) const;
  template <int Points>
  Vec3 velocity_at(const Lattice& lattice, const Vec3& position) const;
  template <int Points>
  void spread_one(Lattice& lattice, const Vec3& position, const Vec3& force) const;
  template <int Points>
  double weight_on_walls(const Lattice& lattice, const Vec3& position) const;

  int kernel_points_;
  Decomposition decomposition_;
  Box own_;
};

}  // namespace npfem::flow
