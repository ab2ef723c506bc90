// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/reference/cell_state.h"
#include "backend/reference/step_factor.h"
#include "backend/solver_options.h"

namespace npfem {

/// How a step forms the derivative at its end: dq/dt = [q_{n+1} - q_n - past (q_n - q_{n-1})]/h, for q the positions,
/// the velocities and the metric of every triangle alike.
///   implicit Euler: h = dt,     past = 0    (order 1)
///   BDF2:           h = 2 dt/3, past = 1/3  (order 2; Curtiss & Hirschfelder 1952)
struct Differencing {
  double h;  ///< us
  double past;
};

Differencing euler_differencing(const SolverOptions& options);
Differencing bdf2_differencing(const SolverOptions& options);

/// That of the cell's next step. With the option integrator = 1 it is BDF2, except where both lag fields are zero: such
/// a cell has no past (or moved uniformly, which is the same to either scheme) and starts by one step of implicit
/// Euler, whose error of dt^2 keeps the second order of the whole.
Differencing differencing(const SolverOptions& options, const CellState& cell);

/// Whether a step that ended like this is worth Newton's price: one that would fail, and any other above its tolerance
/// unless the forces have no potential, where Newton's method stalls as well.
bool needs_newton(const Model& model, const SolverOptions& options, CellStatus status);

/// One implicit step of one cell, alone or, by implicit Euler, in a fluid. A failed cell keeps its state.
///
/// Two masses act on a vertex: its own m_s, and the mass m_f of the fluid that moves with it, which has the velocity u.
/// The past is kept as what it differs by from uniform motion,
///   w_n = (x_n - x_{n-1})/dt - v_n  (lag_velocity),   a_n = (v_n - v_{n-1})/dt  (lag_acceleration),
/// so that digits survive far from the origin. The step is the minimum of StepObjective over d = x_{n+1} - x_n with
///   mu = (m_s + m_f)/h^2,   force = f_ext - f_old,
///   drift = past dt (v_n + w_n) + h V,   (m_s + m_f) V = m_s (v_n + past dt a_n) + m_f u,
/// f_old the force that the fluid holds already. Then
///   v_{n+1} = [d - past dt (v_n + w_n)]/h,   w_{n+1} = d/dt - v_{n+1},   a_{n+1} = (v_{n+1} - v_n)/dt.
/// Contacts load a vertex with f_c - k (x - x_n - dt v_n): f_c is part of f_ext, found by the host at the predicted
/// position, and k (contact_stiffness) keeps a stiff contact from being overshot. It adds k to mu and moves drift towards
/// dt v_n accordingly.
/// The fluid receives F = f_old + m_f (v - u)/dt. Taking u - dt f_old/m for u is what keeps the membrane from slipping
/// through the fluid (see docs/theory.md, coupling). With integrator = 0 no past is kept: w = a = 0.
/// `factor` is that of `differencing(options, cell).h`.
void time_step(const Model& model, const StepFactor& factor, std::span<const Patch> patches,
               const SolverOptions& options, CellState& cell);

}  // namespace npfem
