// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/line_search.h"

#include <algorithm>

namespace npfem {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo constant
constexpr double rounding = 64 * 2.2e-16;     // of the objective, relative to the magnitudes of its parts

}  // namespace

LineSearch line_search(const StepObjective& objective, const Trial& from, const VertexField& direction, int max_trials,
                       Trial& to) {
  const double slope = inner(from.gradient, direction);
  double step = 1;
  for (int trial = 1; trial <= max_trials; ++trial) {
    to.displacement = from.displacement + step * direction;
    to.evaluate(objective);
    double shorter = 0.1 * step;
    if (to.finite()) {
      const double change = to.value - from.value;
      if (change <= sufficient_decrease * step * slope) return {step, trial};
      // Where the change of the objective drowns in its rounding, the slope decides instead (Hager & Zhang 2005,
      // approximate Wolfe condition): it must have become flatter.
      // A force that is the gradient of nothing has no hill to go down: there the slope always decides.
      const double noise = rounding * std::max(from.scale, to.scale);
      const bool unclear = !objective.model.has_potential() || std::abs(change) <= noise;
      if (unclear && std::abs(inner(to.gradient, direction)) <= 0.9 * std::abs(slope)) {
        return {step, trial};
      }
      // Minimum of the parabola through value, slope and the new value.
      shorter = std::clamp(-0.5 * slope * step * step / (change - step * slope), 0.1 * step, 0.5 * step);
    }
    step = shorter;
  }
  return {0, max_trials};
}

}  // namespace npfem
