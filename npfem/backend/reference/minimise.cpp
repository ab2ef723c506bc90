// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/minimise.h"

#include <algorithm>
#include <cmath>

#include "backend/reference/lbfgs.h"

namespace npfem {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo constant
constexpr double rounding = 64 * 2.2e-16;     // of the objective, relative to the magnitudes of its parts

/// A point of the search with everything known about it.
struct Trial {
  VertexField displacement, gradient;
  double value = 0, scale = 0;

  void evaluate(const StepObjective& objective) { value = objective(displacement, gradient, scale); }
  bool finite() const { return std::isfinite(value) && gradient.allFinite(); }
  double residual() const { return gradient.cwiseAbs().maxCoeff(); }
};

enum class Search { accepted, failed };

/// Backtracking along `direction` from `from`. Where the change of the objective drowns in its rounding, the slope
/// decides instead (Hager & Zhang 2005, approximate Wolfe condition): it must have become flatter.
Search line_search(const StepObjective& objective, const Trial& from, const VertexField& direction, int max_trials,
                   Trial& to) {
  const double slope = inner(from.gradient, direction);
  double step = 1;
  for (int trial = 0; trial < max_trials; ++trial) {
    to.displacement = from.displacement + step * direction;
    to.evaluate(objective);
    double shorter = 0.1 * step;
    if (to.finite()) {
      const double change = to.value - from.value;
      if (change <= sufficient_decrease * step * slope) return Search::accepted;
      const double noise = rounding * std::max(from.scale, to.scale);
      if (std::abs(change) <= noise && std::abs(inner(to.gradient, direction)) <= 0.9 * std::abs(slope)) {
        return Search::accepted;
      }
      // Minimum of the parabola through value, slope and the new value.
      shorter = std::clamp(-0.5 * slope * step * step / (change - step * slope), 0.1 * step, 0.5 * step);
    }
    step = shorter;
  }
  return Search::failed;
}

CellStatus verdict(double residual, const SolverOptions& options, CellStatus otherwise) {
  return residual <= options.residual_bound ? CellStatus::iteration_cap : otherwise;
}

}  // namespace

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
      report.status = verdict(report.residual, options, CellStatus::not_converged);
      break;
    }
    ++report.iterations;
    VertexField direction = memory.direction(here.gradient, factor);
    if (!(inner(here.gradient, direction) < 0)) {
      memory.clear();
      direction = memory.direction(here.gradient, factor);
    }
    ++report.evaluations;
    if (line_search(objective, here, direction, options.max_line_search, next) == Search::failed) {
      if (!memory.empty()) {
        memory.clear();
        continue;
      }
      report.status = verdict(report.residual, options, CellStatus::no_descent);
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
