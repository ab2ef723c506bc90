// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "contact/vertex_grid.h"
#include "coupling/vertex_exchange.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// Force (pN) of a smooth repulsion at distance d: strength (1 - d/range)^2 below `range`, 0 beyond; continuous with
/// its slope, and growing on where a wall has been crossed (d < 0).
double repulsion_force(const RepulsionSettings& settings, double distance);

/// Force (pN) on a vertex of one cell from a vertex of another, along the line that joins them. Swapping the two gives
/// the opposite force, bit for bit. `period`: um, per direction, 0 where not periodic; the nearest image acts.
/// Vertices that coincide have no direction to part in and get no force.
Vec3 pair_repulsion(const RepulsionSettings& settings, const Vec3& at, const Vec3& from, const Vec3& period);

/// The repulsions that keep cells off each other and off the walls until lubrication is resolved: between vertices of
/// different cells, and between vertices and the nearest wall. Normal forces only, no friction.
///
/// Every pair is computed by the ranks that hold its vertices, from the same bits; forces on a vertex are summed in
/// order of the partner's (cell, vertex). The result does not depend on the number of ranks.
class Repulsion {
 public:
  /// std::invalid_argument where a range or strength is negative or a range exceeds two node spacings, which is as far
  /// as a rank knows the vertices around it.
  Repulsion(const Setup& setup, const Decomposition& decomposition, const Box& own);

  bool active() const { return setup_.cells.range > 0 || setup_.walls.range > 0; }

  /// Forces on the vertices held by this rank, pN: xyz per entry of known.held, overwritten.
  void evaluate(const KnownVertices& known, std::span<double> forces);

  /// Sum of the wall repulsion over this rank's held vertices at the last evaluate(), pN: what the walls have given to
  /// the suspension from outside. The forces between cells cancel.
  const Vec3& force_of_walls() const { return force_of_walls_; }

 private:
  struct Settings {
    Domain domain;
    Vec3 period;
    RepulsionSettings cells, walls;
  };
  struct Hit {
    std::size_t partner;
    Vec3 force;
  };

  Vec3 from_cells(const KnownVertices& known, std::size_t vertex);
  Vec3 from_walls(const Vec3& position) const;

  Settings setup_;
  VertexGrid grid_;
  std::vector<Hit> hits_;
  Vec3 force_of_walls_{};
};

}  // namespace npfem::flow
