// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <memory>
#include <vector>

#include "coupling/fluid.h"
#include "coupling/immersed_solid.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// A way to let a solid and a fluid advance together by delta = steps_per_solve fluid steps: load_fluid() before them,
/// renew_load() between them, follow_fluid() after them. Collective.
class Coupling {
 public:
  /// The scheme and the time steps of the setup, any scheme but that of the lineage (LineageCoupling); all outlive the
  /// coupling.
  static std::unique_ptr<Coupling> create(const Setup& setup, ImmersedSolid& solid, Fluid& fluid);
  virtual ~Coupling() = default;

  /// Gives the fluid the forces that the vertices exert on it for the next delta.
  virtual CellStepReport load_fluid() = 0;
  /// Before the fluid steps between, `steps_since_solve` after the last one that began with load_fluid().
  virtual void renew_load(int /*steps_since_solve*/) {}
  /// Lets the vertices follow, where they have not moved before.
  virtual CellStepReport follow_fluid() { return {}; }

  /// Both, and the steps of the fluid between them.
  CellStepReport advance();

  /// Lets fluid and solid hold the forces of the present positions: elastic forces and contacts.
  virtual void hold_present_forces();

 protected:
  Coupling(const Setup& setup, ImmersedSolid& solid, Fluid& fluid);

  const Setup& setup_;
  ImmersedSolid& solid_;
  Fluid& fluid_;
  double delta_;                                               // us
  std::vector<double> position_, velocity_, contact_, force_;  // own vertices
};

}  // namespace npfem::flow
