// SPDX-License-Identifier: MPL-2.0
// Three numbers as a vector, nine (row-major) as a rotation: the little algebra that cells among nodes need.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace npfem::flow {

using Vec3 = std::array<double, 3>;
using Rotation = std::array<double, 9>;  ///< row-major

inline constexpr Rotation identity_rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};

constexpr Vec3 add(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
constexpr Vec3 subtract(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
constexpr Vec3 scale(double s, const Vec3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
constexpr double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

/// Number i of vectors that lie one after the other, xyzxyz...
template <class Values>
constexpr Vec3 vector_at(const Values& xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}
template <class Values>
constexpr void set_vector(Values&& xyz, std::size_t i, const Vec3& v) {
  for (std::size_t c = 0; c < 3; ++c) xyz[3 * i + c] = v[c];
}
template <class Values>
constexpr void add_vector(Values&& xyz, std::size_t i, const Vec3& v) {
  for (std::size_t c = 0; c < 3; ++c) xyz[3 * i + c] += v[c];
}

/// R a
constexpr Vec3 rotate(const Rotation& r, const Vec3& a) {
  return {r[0] * a[0] + r[1] * a[1] + r[2] * a[2], r[3] * a[0] + r[4] * a[1] + r[5] * a[2],
          r[6] * a[0] + r[7] * a[1] + r[8] * a[2]};
}

/// R^T a: back into the frame of the turned body.
constexpr Vec3 rotate_back(const Rotation& r, const Vec3& a) {
  return {r[0] * a[0] + r[3] * a[1] + r[6] * a[2], r[1] * a[0] + r[4] * a[1] + r[7] * a[2],
          r[2] * a[0] + r[5] * a[1] + r[8] * a[2]};
}

/// A B: first B, then A.
constexpr Rotation compose(const Rotation& a, const Rotation& b) {
  Rotation c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    }
  }
  return c;
}

/// Of a unit quaternion w + xi + yj + zk.
constexpr Rotation rotation_of_quaternion(double w, double x, double y, double z) {
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

/// Right-handed, by `angle` (rad) about the unit vector `axis`.
inline Rotation rotation_about(const Vec3& axis, double angle) {
  const double s = std::sin(0.5 * angle);
  return rotation_of_quaternion(std::cos(0.5 * angle), s * axis[0], s * axis[1], s * axis[2]);
}

/// About the fixed axes, x first, then y, then z (rad).
inline Rotation rotation_about_xyz(const Vec3& angles) {
  return compose(rotation_about({0, 0, 1}, angles[2]),
                 compose(rotation_about({0, 1, 0}, angles[1]), rotation_about({1, 0, 0}, angles[0])));
}

}  // namespace npfem::flow
