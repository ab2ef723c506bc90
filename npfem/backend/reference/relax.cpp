// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/relax.h"

#include <algorithm>

#include "backend/newton.h"

namespace npfem {

void relax_cell(const Model& model, const StepFactor& factor, std::span<const Patch> patches,
                const SolverOptions& options, CellState& cell) {
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  const Eigen::VectorXd inertia = Eigen::VectorXd::Zero(n);
  const VertexField drift = VertexField::Zero(n, 3);
  const Dissipation none(model);
  const StepObjective objective{model, cell.position, inertia, drift, cell.external_force, none, patches, cell.tied_at};
  const double tolerance = std::max(options.tolerance, attainable_residual(objective));
  VertexField displacement = drift, gradient(n, 3);
  cell.report = minimise(objective, factor, options, {options.relax_iterations, tolerance}, displacement, gradient);
  finish_by_newton(objective, options, displacement, gradient, cell.report);
  if (has_failed(cell.report.status)) return;
  cell.position += displacement;
  cell.velocity.setZero();
  cell.forget_past();
}

}  // namespace npfem
