// SPDX-License-Identifier: MPL-2.0
#include "contact/contact_law.h"

#include <algorithm>
#include <cmath>

namespace npfem::flow {
namespace {

constexpr double end_of_attraction = 4;             // in widths beyond the range
constexpr double whole_depth = 1.4110070159112256;  // one over the integral of 2 (e^-s - e^-2s) (1 - (s/4)^2)^2

}  // namespace

double ContactLaw::reach() const {
  return depth > 0 ? range + end_of_attraction * width : range;
}

double ContactLaw::traction(double distance) const {
  if (!active()) return 0;
  if (distance < range) {
    const double overlap = 1 - std::max(distance / range, -1.0);
    return strength * overlap * overlap;
  }
  if (!(distance < reach())) return 0;
  const double s = (distance - range) / width;
  const double fade = 1 - s * s / (end_of_attraction * end_of_attraction);
  return -2 * whole_depth * (depth / width) * (std::exp(-s) - std::exp(-2 * s)) * fade * fade;
}

double ContactLaw::slope(double distance) const {
  if (!active()) return 0;
  if (distance < range) return 2 * strength * (1 - std::max(distance / range, -1.0)) / range;
  if (!(distance < reach())) return 0;
  const double s = (distance - range) / width;
  return std::max(0.0, 2 * whole_depth * depth / (width * width) * (2 * std::exp(-2 * s) - std::exp(-s)));
}

}  // namespace npfem::flow
