// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/reference/cell_state.h"
#include "backend/reference/step_factor.h"
#include "backend/solver_options.h"

namespace npfem {

/// One implicit Euler step of one cell, alone or in a fluid.
///
/// Two masses act on a vertex: its own m_s, which keeps the velocity v_n, and the mass m_f of the fluid that moves with
/// it, which has the velocity u. The step is the minimum of StepObjective with
///   mu = (m_s + m_f)/dt^2,  mu drift = (m_s v_n + m_f u)/dt,  force = f_ext - f_old,
/// f_old the force that the fluid holds already. The fluid then receives F = f_old + m_f (v - u)/dt. Taking u - dt
/// f_old/m for u is what keeps the membrane from slipping through the fluid (see docs/theory.md, coupling). A failed
/// cell keeps its state.
void implicit_euler_step(const Model& model, const StepFactor& factor, std::span<const Patch> patches,
                         const SolverOptions& options, CellState& cell);

}  // namespace npfem
