// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

// A hinge is an interior edge with its two triangles: x[0] -> x[1] the edge as it runs in triangle A = (0, 1, 2);
// triangle B = (1, 0, 3).

/// e = sum c_i x_i: for a hinge near its rest shape |e| = (edge length) * (angle between the triangles). Linear in the
/// positions with constant cotangent coefficients (Bergou et al., "A quadratic bending model", SGP 2006, eq. 3).
template <class R>
struct HingeRow {
  R coefficient[4];

  template <class T>
  NPFEM_HD Vec3<T> apply(const Vec3<T> (&x)[4]) const {
    return coefficient[0] * x[0] + coefficient[1] * x[1] + coefficient[2] * x[2] + coefficient[3] * x[3];
  }
};

/// Cotangent of the angle at `corner` between the directions to `a` and `b`.
template <class R>
NPFEM_HD R cotangent(const Vec3<R>& corner, const Vec3<R>& a, const Vec3<R>& b) {
  const Vec3<R> u = a - corner, v = b - corner;
  return dot(u, v) / norm(cross(u, v));
}

template <class R>
NPFEM_HD HingeRow<R> hinge_row(const Vec3<R> (&x)[4]) {
  const R at0_a = cotangent(x[0], x[1], x[2]), at1_a = cotangent(x[1], x[0], x[2]);
  const R at0_b = cotangent(x[0], x[1], x[3]), at1_b = cotangent(x[1], x[0], x[3]);
  return {{at1_a + at1_b, at0_a + at0_b, -(at1_a + at0_a), -(at1_b + at0_b)}};
}

/// Area of both triangles together, um^2.
template <class R>
NPFEM_HD R hinge_area(const Vec3<R> (&x)[4]) {
  const Vec3<R> edge = x[1] - x[0];
  return R(0.5) * (norm(cross(edge, x[2] - x[0])) + norm(cross(edge, x[3] - x[0])));
}

/// Cosine and sine of the signed angle between the normals of the two triangles; positive where the surface is convex.
template <class T>
struct HingeAngle {
  T cosine, sine;
  Vec3<T> normal_a, normal_b;  ///< twice the area vectors, um^2
  Vec3<T> edge;                ///< um
  T edge_length;               ///< um
};

template <class T>
NPFEM_HD HingeAngle<T> hinge_angle(const Vec3<T> (&x)[4]) {
  const Vec3<T> edge = x[1] - x[0];
  const Vec3<T> a = cross(edge, x[2] - x[0]);
  const Vec3<T> b = cross(x[3] - x[0], edge);
  const T length = norm(edge);
  // The sine comes from the triple product, so neither an inverse cosine nor the sign is ever lost.
  const T scale = T(1) / larger(norm(a) * norm(b), T(1e-30f));
  const T sine = dot(cross(a, b), edge) * scale / larger(length, T(1e-30f));
  return {dot(a, b) * scale, sine, a, b, edge, length};
}

/// Writes slope * d(theta)/dx, theta the angle of the hinge.
template <class T>
NPFEM_HD void hinge_angle_gradient(const Vec3<T> (&x)[4], const HingeAngle<T>& angle, const T& slope,
                                   Vec3<T> (&gradient)[4]) {
  // Moving an opposite vertex outward by h opens the hinge by h / (its height over the edge).
  const T tiny = T(1e-30f);
  const Vec3<T> outer_a =
      (-slope * angle.edge_length / larger(dot(angle.normal_a, angle.normal_a), tiny)) * angle.normal_a;
  const Vec3<T> outer_b =
      (-slope * angle.edge_length / larger(dot(angle.normal_b, angle.normal_b), tiny)) * angle.normal_b;
  // The edge takes the opposite forces, shared by where each opposite vertex projects on it: no net force or torque.
  const T per_square = T(1) / larger(angle.edge_length * angle.edge_length, tiny);
  const T share_a = dot(x[2] - x[0], angle.edge) * per_square;
  const T share_b = dot(x[3] - x[0], angle.edge) * per_square;
  gradient[2] = outer_a;
  gradient[3] = outer_b;
  gradient[1] = -(share_a * outer_a + share_b * outer_b);
  gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
}

}  // namespace npfem
