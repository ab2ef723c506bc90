// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

// Four points in cyclic order are their centre and three vectors, an orthonormal change of coordinates:
//   p = (-x0 + x1 + x2 - x3)/2,   q = (-x0 - x1 + x2 + x3)/2,   z = (x0 - x1 + x2 - x3)/2.
// They form a parallelogram with half sides p/2, q/2 where z = 0, and a rectangle where also p . q = 0.

template <class T>
struct Quadrilateral {
  Vec3<T> p, q, z;
};

template <class T>
NPFEM_HD Quadrilateral<T> quadrilateral(const Vec3<T> (&x)[4]) {
  const Vec3<T> along = x[2] - x[0], across = x[1] - x[3];
  return {T(0.5f) * (along + across), T(0.5f) * (along - across), T(0.5f) * ((x[0] - x[1]) + (x[2] - x[3]))};
}

/// Parallelograms by E = (w/2) |z|^2, rectangles by E = (w/2) [|z|^2 + distance^2 of p, q to the nearest orthogonal
/// pair]. In closed form that distance^2 is (S - sqrt(S^2 - 4 c^2))/2 with S = |p|^2 + |q|^2, c = p . q: the nearest
/// pair p', q' obeys p - p' = m q', q - q' = m p' for one m.
template <bool rectangular>
struct QuadrilateralShape {
  static constexpr const char* name = rectangular ? "rectangle" : "parallelogram";
  static constexpr int num_vertices = 4;
  static constexpr bool zero_at_rest = false;

  template <class R>
  struct Params {
    R weight;  ///< w, pN/um
  };
  template <class R>
  struct Rest {
    R size_square;  ///< |p|^2 + |q|^2, um^2: the measure of what is small
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[4], const Params<R>&) {
    const Quadrilateral<R> shape = quadrilateral(x);
    return {dot(shape.p, shape.p) + dot(shape.q, shape.q)};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[4], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[4]) {
    const Quadrilateral<T> s = quadrilateral(x);
    const R half_weight = R(0.5) * params.weight;
    T energy = half_weight * dot(s.z, s.z);
    const Vec3<T> by_z = half_weight * s.z;  // half of dE/dz, as every x has half of each vector
    Vec3<T> by_p{T(R(0)), T(R(0)), T(R(0))}, by_q = by_p;
    if constexpr (rectangular) {
      const T sum = dot(s.p, s.p) + dot(s.q, s.q), product = dot(s.p, s.q);
      // Where p = +-q, all four points on a line, the nearest rectangle is not unique and the slope is bounded.
      const T root =
          larger(square_root(larger(sum * sum - R(4) * product * product, T(R(0)))), T(R(1e-6) * rest.size_square));
      energy = energy + half_weight * (R(2) * product * product / (sum + root));
      const T turn = R(2) * product / root;
      const T shrink = R(1) - sum / root;
      by_p = (R(0.5) * half_weight) * (shrink * s.p + turn * s.q);
      by_q = (R(0.5) * half_weight) * (shrink * s.q + turn * s.p);
    }
    gradient[0] = by_z - by_p - by_q;
    gradient[1] = by_p - by_q - by_z;
    gradient[2] = by_p + by_q + by_z;
    gradient[3] = by_q - by_p - by_z;
    return energy;
  }

  template <class R>
  static int weight_rows(const Rest<R>&, const Params<R>& params, R (&rows)[3][4]) {
    const R half = R(0.5) * square_root(params.weight);
    const R signs[3][4] = {{1, -1, 1, -1}, {-1, 1, 1, -1}, {-1, -1, 1, 1}};
    const int num_rows = rectangular ? 3 : 1;
    for (int r = 0; r < num_rows; ++r) {
      for (int i = 0; i < 4; ++i) rows[r][i] = half * signs[r][i];
    }
    return num_rows;
  }
};

using ParallelogramShape = QuadrilateralShape<false>;
using RectangleShape = QuadrilateralShape<true>;

}  // namespace npfem
