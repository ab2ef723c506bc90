// SPDX-License-Identifier: MPL-2.0
#include "placement/rigid_fit.h"

#include <cmath>

namespace npfem::flow {
namespace {

Vec3 row(const Rotation& m, std::size_t i) {
  return vector_at(m, i);
}

/// Of the cofactors: det(m) m^-T.
Rotation cofactors(const Rotation& m) {
  const Vec3 a = cross(row(m, 1), row(m, 2)), b = cross(row(m, 2), row(m, 0)), c = cross(row(m, 0), row(m, 1));
  return {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
}

}  // namespace

Vec3 middle_of(std::span<const double> xyz) {
  Vec3 middle{};
  for (std::size_t i = 0; i < xyz.size(); ++i) middle[i % 3] += xyz[i];
  return scale(3.0 / static_cast<double>(xyz.size()), middle);
}

Rotation rotation_between(std::span<const double> shape, std::span<const double> placed) {
  constexpr int most_iterations = 100;
  const Vec3 from = middle_of(shape), to = middle_of(placed);
  Rotation m{};  // sum of placed times shape^T, scaled to the size of a rotation
  double square = 0;
  for (std::size_t v = 0; v < shape.size(); v += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m[3 * i + j] += (placed[v + i] - to[i]) * (shape[v + j] - from[j]);
    }
  }
  for (const double value : m) square += value * value;
  if (!(square > 0)) return identity_rotation;
  for (double& value : m) value *= std::sqrt(3 / square);
  constexpr double flat = 1e-6;
  if (!(dot(row(m, 0), row(cofactors(m), 0)) > flat)) return identity_rotation;
  for (int n = 0; n < most_iterations; ++n) {
    const Rotation adjoint = cofactors(m);
    const double determinant = dot(row(m, 0), row(adjoint, 0));
    double change = 0;
    for (std::size_t i = 0; i < m.size(); ++i) {
      const double next = 0.5 * (m[i] + adjoint[i] / determinant);
      change = std::max(change, std::abs(next - m[i]));
      m[i] = next;
    }
    if (change < 1e-14) break;
  }
  return m;
}

}  // namespace npfem::flow
