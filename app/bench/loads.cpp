// SPDX-License-Identifier: MPL-2.0
#include "bench/loads.h"

#include <cmath>

namespace npfem::app::bench {
namespace {

/// Forces along x, `weight(vertex)` on each, scaled so that those of either sign add up to `force`.
template <class Weight>
std::vector<double> balanced(std::size_t vertices, double force, Weight weight) {
  double side[2] = {0, 0};
  std::vector<double> loads(3 * vertices, 0.0);
  for (std::size_t i = 0; i < vertices; ++i) {
    loads[3 * i] = weight(i);
    side[loads[3 * i] > 0 ? 1 : 0] += std::abs(loads[3 * i]);
  }
  for (std::size_t i = 0; i < vertices; ++i) loads[3 * i] *= force / side[loads[3 * i] > 0 ? 1 : 0];
  return loads;
}

}  // namespace

std::vector<double> stretching_loads(std::span<const double> x, std::span<const double> area, double force) {
  return balanced(area.size(), force, [&](std::size_t i) { return area[i] * x[3 * i] * x[3 * i] * x[3 * i]; });
}

std::vector<double> shearing_loads(std::span<const double> x, std::span<const double> area, double force) {
  return balanced(area.size(), force, [&](std::size_t i) { return area[i] * x[3 * i + 1]; });
}

}  // namespace npfem::app::bench
