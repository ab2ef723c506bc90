// SPDX-License-Identifier: MPL-2.0
#include "output/principal_stretches.h"

#include <algorithm>
#include <cmath>

#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

struct Metric {
  double aa, ab, bb;
};

Metric metric_of(std::span<const double> xyz, const std::int32_t* corners) {
  const auto corner = [&](int c) {
    const auto v = 3 * static_cast<std::size_t>(corners[c]);
    return Vec3{xyz[v], xyz[v + 1], xyz[v + 2]};
  };
  const Vec3 a = subtract(corner(1), corner(0)), b = subtract(corner(2), corner(0));
  return {dot(a, a), dot(a, b), dot(b, b)};
}

PrincipalStretches stretches_of(const Metric& g0, const Metric& g) {
  const double det0 = g0.aa * g0.bb - g0.ab * g0.ab;
  const double half_trace = 0.5 * (g0.bb * g.aa - 2 * g0.ab * g.ab + g0.aa * g.bb) / det0;
  const double det = (g.aa * g.bb - g.ab * g.ab) / det0;
  const double root = std::sqrt(std::max(0.0, half_trace * half_trace - det));
  const double larger = half_trace + root;
  // the smaller one from the product: no cancellation
  return {std::sqrt(larger), larger > 0 ? std::sqrt(std::max(0.0, det / larger)) : 0};
}

}  // namespace

std::vector<PrincipalStretches> principal_stretches(std::span<const double> unstretched, std::span<const double> xyz,
                                                    std::span<const std::int32_t> triangles) {
  std::vector<PrincipalStretches> stretches;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    stretches.push_back(stretches_of(metric_of(unstretched, &triangles[t]), metric_of(xyz, &triangles[t])));
  }
  return stretches;
}

double largest_stretch(std::span<const PrincipalStretches> stretches) {
  double largest = stretches.empty() ? 1 : 0;
  for (const PrincipalStretches& stretch : stretches) largest = std::max(largest, stretch.larger);
  return largest;
}

}  // namespace npfem::flow
