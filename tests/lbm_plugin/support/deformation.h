// SPDX-License-Identifier: MPL-2.0
#pragma once

// Taylor's deformation of a closed surface in a shear flow in the x-y plane.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "geometry/vec3.h"

namespace deformation {

using npfem::flow::Vec3;

struct Solid {
  double volume = 0;
  Vec3 first{};                   // integral of x
  double xx = 0, yy = 0, xy = 0;  // integrals of products
};

/// Sums over the tetrahedra between the triangles and the origin; over a tetrahedron (0, a, b, c) of volume V the
/// integral of x y is V/20 (sum of x_i y_i over the corners + (sum of x_i)(sum of y_i)).
inline Solid solid(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  Solid total;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = 3 * static_cast<std::size_t>(triangles[t + i]);
      p[i] = {xyz[v], xyz[v + 1], xyz[v + 2]};
    }
    const double volume = npfem::flow::dot(p[0], npfem::flow::cross(p[1], p[2])) / 6;
    const auto product = [&](std::size_t a, std::size_t b) {
      double pairs = 0, sum_a = 0, sum_b = 0;
      for (const Vec3& corner : p) {
        pairs += corner[a] * corner[b];
        sum_a += corner[a];
        sum_b += corner[b];
      }
      return volume / 20 * (pairs + sum_a * sum_b);
    };
    total.volume += volume;
    for (std::size_t a = 0; a < 3; ++a) total.first[a] += volume / 4 * (p[0][a] + p[1][a] + p[2][a]);
    total.xx += product(0, 0);
    total.yy += product(1, 1);
    total.xy += product(0, 1);
  }
  return total;
}

/// D = (L - B)/(L + B), L and B the axes in the x-y plane of the ellipsoid with the same second moments.
inline double taylor(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  const Solid s = solid(xyz, triangles);
  const double xx = s.xx - s.first[0] * s.first[0] / s.volume;
  const double yy = s.yy - s.first[1] * s.first[1] / s.volume;
  const double xy = s.xy - s.first[0] * s.first[1] / s.volume;
  const double mean = 0.5 * (xx + yy), half_difference = std::hypot(0.5 * (xx - yy), xy);
  const double longer = std::sqrt(mean + half_difference), shorter = std::sqrt(mean - half_difference);
  return (longer - shorter) / (longer + shorter);
}

}  // namespace deformation
