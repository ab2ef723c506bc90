// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cmath>
#include <random>

#include "energies/vec3.h"

namespace npfem::testing {

/// Uniform numbers, the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double least, double largest) {
    return least + (largest - least) * (static_cast<double>(engine_()) / 4294967295.0);
  }
  Vec3<double> vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937 engine_;
};

/// A triangle (3) or hinge (4) of edges about 1 um, each vertex moved at random by up to `noise`.
template <int N>
void random_element(Random& random, double noise, Vec3<double> (&x)[N]) {
  const Vec3<double> corners[4] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.85, 0.1}, {0.5, -0.85, 0.15}};
  for (int i = 0; i < N; ++i) x[i] = corners[i] + random.vector(noise);
}

/// Rotation by `angle` about `axis` (Rodrigues), then a shift.
inline Vec3<double> moved(const Vec3<double>& x, const Vec3<double>& axis, double angle, const Vec3<double>& shift) {
  const Vec3<double> k = (1 / norm(axis)) * axis;
  return std::cos(angle) * x + std::sin(angle) * cross(k, x) + ((1 - std::cos(angle)) * dot(k, x)) * k + shift;
}

}  // namespace npfem::testing
