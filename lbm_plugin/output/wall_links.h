// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "communicator/communicator.h"
#include "lattice/lattice.h"

namespace npfem::flow {

/// Which forces the walls exert on the fluid, wall by wall.
///
/// A population that has bounced off a wall half-way between the nodes comes back as f_-i = f_i - 6 w_i c_i . u_wall;
/// the wall has given the fluid -c_i (f_i + f_-i) = -c_i (2 f_-i + 6 w_i c_i . u_wall) (Ladd, J. Fluid Mech. 271 (1994)
/// 285). Of the populations after a step the returned ones are known, so that nothing need be recorded in the step.
class WallLinks {
 public:
  WallLinks(const Lattice& lattice, const Geometry& geometry);

  /// Force in the last step, by number of the boundary, lattice units, without the pressure of the density 1. The same
  /// bits for any number of ranks. Collective.
  std::vector<Vec3> forces(const Lattice& lattice, Communicator& communicator) const;

 private:
  struct Link {
    Index3 node;
    int direction;  // towards the wall
    std::size_t boundary;
    double wall_term;  // 6 w_i c_i . u_wall
  };
  std::vector<Link> links_;  // of one node next to each other
  std::size_t boundaries_;
};

}  // namespace npfem::flow
