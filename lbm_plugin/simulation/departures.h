// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "communicator/communicator.h"
#include "geometry/opening.h"
#include "simulation/setup.h"

namespace npfem::flow {

class CellPopulation;

/// A cell that has left the run through an opening.
struct Departure {
  int id;             ///< global id, which no other cell gets
  int type;           ///< index into Setup::types
  std::int64_t step;  ///< fluid steps done when it left
  Face face;          ///< of the opening
  Vec3 centre;        ///< centroid of its volume when it left, um
  double volume;      ///< um3

  bool operator==(const Departure&) const = default;
};

/// The opening that a cell with these vertices (xyz, um) leaves through: one that a vertex is nearer to than
/// Domain::cells_leave_before_opening(), and of several the nearest.
std::optional<Face> opening_reached(const Domain& domain, std::span<const double> positions);

/// Names the first cell that would leave before the first step; empty where there is none.
std::string starts_in_an_opening(const Setup& setup);

/// Lets cells leave through the openings of the domain: a cell is taken out, whole, as soon as one of its vertices is
/// so near to an opening that the kernel would reach the last nodes before it. What the fluid does there is given by
/// the opening: a force that is spread on those nodes would in part be lost, and the velocity asked of them is not that
/// of a suspension. Fluid that was in the cell stays, and what the membrane held it with is gone: with the next forces
/// the fluid holds those of the other cells alone. The forces of a cell on the fluid add up to what acts on it from
/// outside, so none of the momentum that the audit counts goes with it, but that of mass of its own.
///
/// The lineage's coupling, which also spreads at vertices under way between two solves, may touch those nodes by what a
/// cell moves meanwhile.
///
/// Looked at after the steps in which the cells have moved, before output and checkpoints, which therefore never hold
/// a cell in the reach of an opening. What leaves, and when, follows from the vertices of each cell alone.
class Departures {
 public:
  /// Takes those that have reached an opening out of the cells of this rank, and tells every rank. True where any cell
  /// of the system has left. Collective.
  bool let_go(const Setup& setup, std::int64_t step, CellPopulation& cells, Communicator& communicator);

  /// In order of step and id, the same on every rank.
  const std::vector<Departure>& all() const { return all_; }

  /// Goes on with those of an earlier part of the run.
  void restore(std::vector<Departure> earlier) { all_ = std::move(earlier); }

 private:
  std::vector<Departure> all_;
};

}  // namespace npfem::flow
