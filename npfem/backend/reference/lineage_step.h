// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/reference/cell_state.h"
#include "backend/reference/step_factor.h"
#include "backend/solver_options.h"

namespace npfem {

/// The two matrices of a lineage step: M~ = M + dt Cbeta W, and N = M~/dt^2 + W.
struct LineageFactors {
  StepFactor damped_mass;  ///< M~
  StepFactor step;         ///< N
};

/// One time step exactly as the lineage (Palabos-npFEM, `Solver::solve`) takes it, to reproduce its runs:
/// implicit Euler with stiffness-proportional damping, weak Wolfe line search whose last trial is accepted even where
/// it fails, a stop on the scatter of recent objective values, and afterwards the removal of the share Calpha of the
/// non-rigid velocity. The result depends on the time step by construction: use it for comparison only.
void lineage_step(const Model& model, const LineageFactors& factors, std::span<const LineageObstacle> obstacles,
                  const SolverOptions& options, CellState& cell);

}  // namespace npfem
