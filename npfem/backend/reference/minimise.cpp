// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/minimise.h"

#include <limits>

#include "backend/reference/lbfgs.h"
#include "backend/reference/line_search.h"

namespace npfem {

double attainable_residual(const StepObjective& objective) {
  constexpr double ulps = 32 * std::numeric_limits<double>::epsilon();
  const double stiffest_motion = objective.inertia.maxCoeff() + objective.dissipation.stiffest_diagonal();
  return ulps * (stiffest_motion * objective.drift.cwiseAbs().maxCoeff() +
                 objective.model.weight.diagonal().maxCoeff() * objective.start.cwiseAbs().maxCoeff());
}

CellStatus ended_short(double residual, const SolverOptions& options, CellStatus failure) {
  return residual <= options.residual_bound ? CellStatus::iteration_cap : failure;
}

CellReport minimise(const StepObjective& objective, const StepFactor& factor, const SolverOptions& options,
                    const MinimiseLimits& limits, VertexField& displacement, VertexField& gradient) {
  CellReport report;
  report.tolerance = limits.tolerance;
  Trial here, next;
  here.displacement = displacement;
  here.evaluate(objective);
  report.evaluations = 1;
  if (!here.finite()) {
    report.status = CellStatus::not_finite;
    return report;
  }
  Lbfgs memory(options.history);
  report.status = CellStatus::converged;
  while ((report.residual = here.residual()) > limits.tolerance) {
    if (report.iterations == limits.iterations) {
      report.status = ended_short(report.residual, options, CellStatus::not_converged);
      break;
    }
    ++report.iterations;
    VertexField direction = memory.direction(here.gradient, factor);
    if (!(inner(here.gradient, direction) < 0)) {
      memory.clear();
      direction = memory.direction(here.gradient, factor);
    }
    const LineSearch search = line_search(objective, here, direction, options.max_line_search, next);
    report.evaluations += search.evaluations;
    if (search.step == 0) {
      if (!memory.empty()) {
        memory.clear();
        continue;
      }
      report.status = ended_short(report.residual, options, CellStatus::no_descent);
      break;
    }
    const VertexField s = next.displacement - here.displacement, y = next.gradient - here.gradient;
    if (inner(s, y) > 1e-12 * s.norm() * y.norm()) memory.push(s, y);
    std::swap(here, next);
  }
  displacement = here.displacement;
  gradient = here.gradient;
  return report;
}

}  // namespace npfem
