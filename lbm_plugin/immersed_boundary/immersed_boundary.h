// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "immersed_boundary/stencil.h"
#include "immersed_boundary/transfer.h"
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
/// Threads share the vertices in interpolation and layers of nodes in spreading, where each node sums its forces in the
/// order of the vertices.
///
/// Positions in node spacings, forces and velocities in lattice units, all arrays xyzxyz...
class ImmersedBoundary {
 public:
  /// kernel_points: 2, 3 or 4. std::invalid_argument otherwise, or where the lattice holds no forces of nodes. The
  /// lattice must outlive this.
  ImmersedBoundary(int kernel_points, Lattice& lattice);

  /// Velocity at positions[3 v] for every v of `held`, the vertices whose node this rank holds; after
  /// Lattice::update_velocity(). velocities[3 i] belongs to held[i].
  void interpolate(std::span<const double> positions, std::span<const int> held, std::span<double> velocities) const;

  /// Adds the forces to the own nodes of this rank, vertex after vertex in the order given.
  void spread(std::span<const double> positions, std::span<const double> forces);

  /// The part of the forces at the vertices `held` that solid nodes take.
  Vec3 force_on_walls(std::span<const double> positions, std::span<const int> held,
                      std::span<const double> forces) const;

 private:
  bool near_wall(const Index3& node) const;
  void find_strips_near_walls();
  template <int Points>
  double weight_on_walls(const Vec3& position) const;

  int kernel_points_;
  Lattice& lattice_;
  NodeTable table_;
  std::vector<std::uint8_t> near_wall_;  // by strip: a stencil of one of its nodes may touch a node that is not fluid
};

}  // namespace npfem::flow
