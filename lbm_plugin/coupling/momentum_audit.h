// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>

#include "communicator/communicator.h"
#include "lattice/compensated_sum.h"
#include "lattice/lattice.h"

namespace npfem::flow {

/// Does the momentum of fluid and cells change by nothing but the impulses that act on them from outside? Lattice
/// units.
///
/// In one fluid step (see lattice.h) the fluid, counted with half of the held force, P = j + F/2, gains
///   P(t+1) - P(t) = W + F + (F - F_before)/2,
/// W the impulse of the walls through bounced populations and F the total force held by the lattice. If cells and
/// coupling keep momentum, F is known without looking at the lattice:
///   F = body force * fluid nodes + loads on the vertices from outside - d(sum of m_s v)/dt,
/// where the loads are the contact with walls less what was spread on solid nodes, and that by which contacts gave way
/// within the step of the cell solver; and the last term is what the cells' own mass has taken up. Forces inside and
/// between cells must cancel; the audit finds out whether they do. Reported is
///   |P(t) - P(0) - sum of these impulses| / sum of |vertex force| * time,
/// since the start, or over the impulses of body force and walls where there are no cells.
class MomentumAudit {
 public:
  /// Starts at the present state: the lattice holds the force given by hold().
  void start(const Lattice& lattice);

  /// The lattice holds new forces from now on. This rank's shares: `external`, the loads from outside less the rate of
  /// solid momentum; `magnitude`, the sum of |vertex force|.
  void hold(const Lattice& lattice, const Vec3& external, double magnitude);

  /// After every step of the fluid.
  void count_step(const Lattice& lattice);

  /// All that the audit knows, added up over the ranks, for one that goes on elsewhere. Collective.
  using Record = std::array<double, 16>;
  Record record(Communicator& communicator) const;
  /// Goes on from a record: given to one rank, zeros to the others.
  void restore(const Record& record);

  /// Collective.
  double error(const Lattice& lattice, Communicator& communicator) const;

 private:
  using Sum = std::array<CompensatedSum, 3>;

  Sum impulse_;                 // of everything from outside since the start
  CompensatedSum cell_scale_;   // sum of |vertex force|
  CompensatedSum fluid_scale_;  // sum of |body force| and |impulse of walls|
  Vec3 start_momentum_{};
  Vec3 start_force_{};  // F at the start
  Vec3 force_{};        // F now
  double body_magnitude_ = 0;
  double cell_magnitude_ = 0;
};

}  // namespace npfem::flow
