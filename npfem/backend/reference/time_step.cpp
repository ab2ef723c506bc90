// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/time_step.h"

#include <algorithm>

#include "backend/newton.h"
#include "backend/reference/minimise.h"

namespace npfem {

Differencing euler_differencing(const SolverOptions& options) {
  return {options.time_step, 0};
}

Differencing bdf2_differencing(const SolverOptions& options) {
  return {2 * options.time_step / 3, 1.0 / 3};
}

Differencing differencing(const SolverOptions& options, const CellState& cell) {
  const bool has_past = !cell.lag_velocity.isZero(0) || !cell.lag_acceleration.isZero(0);
  if (options.integrator == Integrator::bdf2 && has_past) return bdf2_differencing(options);
  return euler_differencing(options);
}

bool needs_newton(const Model& model, const SolverOptions& options, CellStatus status) {
  if (options.newton_iterations == 0) return false;
  return has_failed(status) || (status == CellStatus::iteration_cap && model.has_potential());
}

namespace {

/// Inertia and the springs of the contacts, at rest at x_n + dt v_n, are one spring at rest between the two. A vertex
/// without contact keeps its bits.
void meet_contacts(const CellState& cell, double dt, const Eigen::VectorXd& inertia, VertexField& drift) {
  for (Eigen::Index i = 0; i < drift.rows(); ++i) {
    const double stiffness = cell.contact_stiffness(i);
    if (stiffness > 0) drift.row(i) += stiffness / inertia(i) * (dt * cell.velocity.row(i) - drift.row(i));
  }
}

}  // namespace

void time_step(const Model& model, const StepFactor& factor, std::span<const Patch> patches,
               const SolverOptions& options, CellState& cell) {
  const double dt = options.time_step;
  const auto [h, past] = differencing(options, cell);
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  const auto solid_mass = model.solid_masses();
  const Eigen::VectorXd mass = solid_mass + cell.ambient_mass;
  const Eigen::VectorXd inertia = mass / (h * h) + cell.contact_stiffness;
  const VertexField last_move = dt * (cell.velocity + cell.lag_velocity);
  const VertexField momentum = solid_mass.asDiagonal() * (cell.velocity + past * dt * cell.lag_acceleration) +
                               cell.ambient_mass.asDiagonal() * cell.ambient_velocity;
  VertexField drift = past * last_move + h * mass.cwiseInverse().asDiagonal() * momentum;
  meet_contacts(cell, dt, inertia, drift);
  const VertexField force = cell.external_force - cell.held_force;
  const Dissipation dissipation(model, cell.position, last_move, past, h);
  const StepObjective objective{model, cell.position, inertia, drift, force, dissipation, patches, cell.tied_at};

  VertexField displacement = drift, gradient(n, 3);
  const double tolerance = std::max(options.tolerance, attainable_residual(objective));
  cell.report = minimise(objective, factor, options, {options.max_iterations, tolerance}, displacement, gradient);
  if (needs_newton(model, options, cell.report.status))
    finish_by_newton(objective, options, displacement, gradient, cell.report);
  if (has_failed(cell.report.status)) return;

  // What residual force is left over has a mean, and the mean would be lost momentum. A rigid translation takes it out
  // exactly, where neither elastic nor viscous energy feels a translation.
  if (model.is_translation_invariant()) displacement.rowwise() -= gradient.colwise().sum() / inertia.sum();

  const VertexField velocity = (displacement - past * last_move) / h;
  if (options.integrator == Integrator::bdf2) {
    cell.lag_velocity = displacement / dt - velocity;
    cell.lag_acceleration = (velocity - cell.velocity) / dt;
  } else {
    cell.forget_past();
  }
  cell.position += displacement;
  cell.velocity = velocity;
  cell.held_force += cell.ambient_mass.asDiagonal() * (cell.velocity - cell.ambient_velocity) / dt;
}

}  // namespace npfem
