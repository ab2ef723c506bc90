// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cmath>

#include "backend/reference/objective.h"

namespace npfem {

/// A point of a search with everything known about it.
struct Trial {
  VertexField displacement, gradient;
  double value = 0, scale = 0;

  void evaluate(const StepObjective& objective) { value = objective(displacement, gradient, scale); }
  bool finite() const { return std::isfinite(value) && gradient.allFinite(); }
  /// Largest component of the residual force, pN.
  double residual() const { return gradient.cwiseAbs().maxCoeff(); }
};

struct LineSearch {
  double step;      ///< the share of the direction that was accepted; 0 where none was
  int evaluations;  ///< of the objective
};

/// Backtracking along `direction` from `from`; writes the accepted point to `to`. Where the forces have a potential it
/// never accepts a point that is higher by more than the rounding of the objective.
LineSearch line_search(const StepObjective& objective, const Trial& from, const VertexField& direction, int max_trials,
                       Trial& to);

}  // namespace npfem
