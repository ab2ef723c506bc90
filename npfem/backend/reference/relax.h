// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/reference/cell_state.h"
#include "backend/reference/step_factor.h"
#include "backend/solver_options.h"

namespace npfem {

/// Static equilibrium under the external forces; velocities become zero. Quasi-Newton iterations around `factor`, that
/// of the bare weights, and Newton's method where those stop short. A failed cell keeps its state.
void relax_cell(const Model& model, const StepFactor& factor, std::span<const Patch> patches,
                const SolverOptions& options, CellState& cell);

}  // namespace npfem
