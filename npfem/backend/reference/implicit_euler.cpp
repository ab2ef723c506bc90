// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/implicit_euler.h"

#include <algorithm>

#include "backend/newton.h"
#include "backend/reference/minimise.h"

namespace npfem {
void implicit_euler_step(const Model& model, const StepFactor& factor, std::span<const Patch> patches,
                         const SolverOptions& options, CellState& cell) {
  const double dt = options.time_step;
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  const Eigen::Map<const Eigen::VectorXd> solid_mass(model.solid_mass.data(), n);
  const Eigen::VectorXd mass = solid_mass + cell.ambient_mass;
  const Eigen::VectorXd inertia = mass / (dt * dt);
  const VertexField momentum =
      solid_mass.asDiagonal() * cell.velocity + cell.ambient_mass.asDiagonal() * cell.ambient_velocity;
  const VertexField drift = dt * mass.cwiseInverse().asDiagonal() * momentum;
  const VertexField force = cell.external_force - cell.held_force;
  const StepObjective objective{model, cell.position, inertia, drift, force, patches, cell.tied_at};

  VertexField displacement = drift, gradient(n, 3);
  const double tolerance = std::max(options.tolerance, attainable_residual(objective));
  cell.report = minimise(objective, factor, options, {options.max_iterations, tolerance}, displacement, gradient);
  finish_by_newton(objective, options, displacement, gradient, cell.report);
  if (has_failed(cell.report.status)) return;

  // What residual force is left over has a mean, and the mean would be lost momentum. A rigid translation takes it out
  // exactly, because no elastic energy feels a translation.
  displacement.rowwise() -= gradient.colwise().sum() / inertia.sum();

  cell.position += displacement;
  cell.velocity = displacement / dt;
  cell.held_force += cell.ambient_mass.asDiagonal() * (cell.velocity - cell.ambient_velocity) / dt;
}

}  // namespace npfem
