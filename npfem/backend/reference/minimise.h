// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cell_status.h"
#include "backend/reference/objective.h"
#include "backend/reference/step_factor.h"
#include "backend/solver_options.h"

namespace npfem {

struct MinimiseLimits {
  int iterations;
  double tolerance;  ///< pN, largest component of the gradient
};

/// Quasi-Newton minimisation with L-BFGS around the shared factor. The line search never accepts a step that raises the
/// objective beyond its rounding. On return `displacement` is the best point found and `gradient` its residual force.
CellReport minimise(const StepObjective& objective, const StepFactor& factor, const SolverOptions& options,
                    const MinimiseLimits& limits, VertexField& displacement, VertexField& gradient);

/// The smallest residual that rounding lets the minimum of this objective reach: a few ulps of the largest forces in
/// it, pN.
double attainable_residual(const StepObjective& objective);

/// A minimisation that ended above its tolerance: usable where the residual force is within the bound, else `failure`.
CellStatus ended_short(double residual, const SolverOptions& options, CellStatus failure);

}  // namespace npfem
