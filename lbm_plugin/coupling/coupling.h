// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <memory>
#include <vector>

#include "coupling/cell_population.h"
#include "coupling/fluid_link.h"
#include "coupling/momentum_audit.h"
#include "simulation/setup.h"
#include "units.h"

namespace npfem::flow {

/// The parts that a coupling scheme works on; they outlive it.
struct CoupledParts {
  const Setup& setup;
  const Units& units;
  CellPopulation& cells;
  FluidLink& fluid;
  Lattice& lattice;
  MomentumAudit& audit;
  Communicator& communicator;
};

/// A way to let cells and fluid advance together by delta = steps_per_solve fluid steps: load_fluid() before them,
/// renew_load() between them, follow_fluid() after them. Collective.
class Coupling {
 public:
  static std::unique_ptr<Coupling> create(const CoupledParts& parts);
  virtual ~Coupling() = default;

  /// Gives the lattice the forces that the vertices exert on it for the next delta.
  virtual CellStepReport load_fluid() = 0;
  /// Before the fluid steps between, `steps_since_solve` after the last one that began with load_fluid().
  virtual void renew_load(int /*steps_since_solve*/) {}
  /// Lets the vertices follow, where they have not moved before.
  virtual CellStepReport follow_fluid() { return {}; }

  /// Lets fluid and cells hold the forces of the present positions: elastic forces and contacts.
  virtual void hold_present_forces();

 protected:
  explicit Coupling(const CoupledParts& parts);

  /// Spreads force_ where the vertices were located and books it.
  void apply_forces(const Vec3& outside);
  /// Makes force_ known to the audit of momentum; `outside`: what the cells give to the fluid beside what acts on them
  /// from walls, pN.
  void book_forces(const Vec3& outside);

  CoupledParts parts_;
  double delta_;                                               // us
  std::vector<double> position_, velocity_, contact_, force_;  // own vertices
};

}  // namespace npfem::flow
