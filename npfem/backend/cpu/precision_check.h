// SPDX-License-Identifier: MPL-2.0
// Whether single precision can carry a model at all. Told before any step, since afterwards the rounding of its forces
// would pass for physics.
#pragma once

#include "backend/solver_options.h"
#include "model/model.h"

namespace npfem::cpu {

/// How stiff a model is for its size.
struct StiffestForce {
  double stiffness;  ///< of the vertex that resists most, pN/um; with the energies of the whole cell
  double reach;      ///< largest coordinate about the cell's centre, um
  /// Largest force between vertices that cancels in the sum, pN: |K| |x| of the second derivative K. Positions in
  /// single precision are known to a share of 1.2e-7, and forces therefore to that share of this one.
  double force;
};

StiffestForce stiffest_force(const Model& model);

/// The rounding error of a force in single precision, pN; what the kernels cannot come below, whatever the tolerance.
double rounding_in_float(const StiffestForce& stiffest);

/// For precision = 2. Throws Error(bad_input) where the rounding of the forces is more than residual_bound, so that no
/// step could be told from a failed one.
void require_forces_in_float(const StiffestForce& stiffest, const SolverOptions& options);

/// For precision = 1 and 2. Throws Error(bad_input): the matrix of a step, exact in double, has entries that single
/// precision cannot hold.
[[noreturn]] void refuse_factor_in_float(const SolverOptions& options);

}  // namespace npfem::cpu
