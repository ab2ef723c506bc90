// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/symmetric_eigen.h"

namespace npfem {

/// A 3 x 3 matrix by its columns.
template <class T>
struct Matrix3 {
  Vec3<T> column[3];
};

template <class T>
NPFEM_HD Vec3<T> operator*(const Matrix3<T>& a, const Vec3<T>& v) {
  return v.x * a.column[0] + v.y * a.column[1] + v.z * a.column[2];
}

/// F = sum_i value_i left_i right_i^T with rotations on both sides: value[2] is negative where F turns space inside
/// out, so that the nearest rotation is sum_i left_i right_i^T in every case.
template <class T>
struct SingularValues {
  T value[3];
  Vec3<T> left[3], right[3];

  /// sum_i d_i left_i right_i^T.
  NPFEM_HD Matrix3<T> matrix(const T (&d)[3]) const {
    Matrix3<T> sum;
    const Vec3<T> scaled[3] = {d[0] * left[0], d[1] * left[1], d[2] * left[2]};
    sum.column[0] = right[0].x * scaled[0] + right[1].x * scaled[1] + right[2].x * scaled[2];
    sum.column[1] = right[0].y * scaled[0] + right[1].y * scaled[1] + right[2].y * scaled[2];
    sum.column[2] = right[0].z * scaled[0] + right[1].z * scaled[1] + right[2].z * scaled[2];
    return sum;
  }
};

/// v scaled to length 1, or `fallback` where v is zero.
template <class T>
NPFEM_HD Vec3<T> unit_or(const Vec3<T>& v, const Vec3<T>& fallback) {
  const T tiny = T(1e-15f), length = norm(v);
  return select_vector(fallback, (T(1) / larger(length, tiny)) * v, length, tiny);
}

/// Some unit vector at right angles to the unit vector u.
template <class T>
NPFEM_HD Vec3<T> perpendicular(const Vec3<T>& u) {
  const T zero = T(0), one = T(1);
  const Vec3<T> axis = select_vector(Vec3<T>{one, zero, zero}, Vec3<T>{zero, one, zero}, absolute(u.x), T(0.6f));
  const Vec3<T> normal = cross(u, axis);
  return (one / norm(normal)) * normal;
}

/// Squares the matrix: values below 1e-8 of the largest one carry no digits (1e-4 in float).
template <class T>
NPFEM_HD SingularValues<T> singular_values(const Matrix3<T>& f) {
  const Vec3<T>* c = f.column;
  const SymmetricEigen<T> e = symmetric_eigen(Symmetric3<T>{dot(c[0], c[0]), dot(c[0], c[1]), dot(c[0], c[2]),
                                                            dot(c[1], c[1]), dot(c[1], c[2]), dot(c[2], c[2])});
  SingularValues<T> s;
  const Vec3<T> image[3] = {f * e.vector[0], f * e.vector[1], f * e.vector[2]};
  s.left[0] = unit_or(image[0], Vec3<T>{T(1), T(0), T(0)});
  const Vec3<T> spare = perpendicular(s.left[0]);
  const Vec3<T> second = unit_or(image[1] - dot(image[1], s.left[0]) * s.left[0], spare);
  s.left[1] = unit_or(second - dot(second, s.left[0]) * s.left[0], spare);  // again: the first may have lost digits
  s.left[2] = cross(s.left[0], s.left[1]);
  for (int i = 0; i < 3; ++i) {
    s.right[i] = e.vector[i];
    s.value[i] = dot(s.left[i], image[i]);
  }
  return s;
}

}  // namespace npfem
