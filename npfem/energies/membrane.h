// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// How a surface law answers a strain: energy per rest area and its derivatives by the two invariants.
template <class T>
struct SurfaceResponse {
  T energy;         ///< W, pN/um
  T by_square_sum;  ///< dW/dt, t = l1^2 + l2^2 (l1, l2: principal stretches)
  T by_area_ratio;  ///< dW/dJ, J = l1 l2
};

/// In-plane strain of a linear triangle. Both invariants come from the metric, without a singular value decomposition.
template <class R>
struct TriangleRest {
  R inverse_metric_11, inverse_metric_12, inverse_metric_22;  ///< of the rest edges x1 - x0 and x2 - x0, 1/um^2
  R area;                                                     ///< um^2
  R per_twice_area;                                           ///< 1/(2 area), 1/um^2
};

template <class R>
NPFEM_HD TriangleRest<R> triangle_rest(const Vec3<R> (&rest)[3]) {
  const Vec3<R> e1 = rest[1] - rest[0], e2 = rest[2] - rest[0];
  const R g11 = dot(e1, e1), g12 = dot(e1, e2), g22 = dot(e2, e2);
  const R determinant = g11 * g22 - g12 * g12;
  const R twice_area = norm(cross(e1, e2));
  return {g22 / determinant, -g12 / determinant, g11 / determinant, R(0.5) * twice_area, R(1) / twice_area};
}

/// A deformed triangle, as every law of the membrane sees it.
template <class T>
struct TriangleStrain {
  Vec3<T> e1, e2;       ///< edges x1 - x0 and x2 - x0, um
  Vec3<T> area_vector;  ///< e1 x e2: twice the area along the outward normal, um^2
  Vec3<T> unit_normal;  ///< zero for a triangle collapsed to a line: its area then pulls nowhere
  T twice_area;         ///< um^2
  T square_sum;         ///< t = l1^2 + l2^2
  T area_ratio;         ///< J = l1 l2
};

template <class T, class R>
NPFEM_HD TriangleStrain<T> triangle_strain(const Vec3<T> (&x)[3], const TriangleRest<R>& rest) {
  TriangleStrain<T> s;
  s.e1 = x[1] - x[0], s.e2 = x[2] - x[0];
  s.area_vector = cross(s.e1, s.e2);
  s.twice_area = norm(s.area_vector);
  s.unit_normal = (T(1) / larger(s.twice_area, T(1e-30f))) * s.area_vector;
  s.square_sum = rest.inverse_metric_11 * dot(s.e1, s.e1) + R(2) * rest.inverse_metric_12 * dot(s.e1, s.e2) +
                 rest.inverse_metric_22 * dot(s.e2, s.e2);
  s.area_ratio = rest.per_twice_area * s.twice_area;
  return s;
}

/// dE/dx (pN) of E = A0 W, from the response of one law or the sum of the responses of several.
template <class T, class R>
NPFEM_HD void triangle_gradient(const TriangleStrain<T>& s, const TriangleRest<R>& rest, const SurfaceResponse<T>& w,
                                Vec3<T> (&gradient)[3]) {
  const T a = R(2) * rest.area * w.by_square_sum;
  const T b = R(0.5) * w.by_area_ratio;
  gradient[1] = a * (rest.inverse_metric_11 * s.e1 + rest.inverse_metric_12 * s.e2) + b * cross(s.e2, s.unit_normal);
  gradient[2] = a * (rest.inverse_metric_12 * s.e1 + rest.inverse_metric_22 * s.e2) + b * cross(s.unit_normal, s.e1);
  gradient[0] = -(gradient[1] + gradient[2]);
}

/// Rows r with sum r r^T = stiffness A0 (grad . grad): a triangle's part of the quasi-Newton matrix, positive
/// semidefinite by construction. Returns the number of rows.
template <class R>
int laplacian_rows(const TriangleRest<R>& rest, R stiffness, R (&rows)[2][3]) {
  const R scale = square_root(stiffness * rest.area);
  const R l11 = square_root(rest.inverse_metric_11);
  const R l21 = rest.inverse_metric_12 / l11;
  const R l22 = square_root(rest.inverse_metric_22 - l21 * l21);
  rows[0][0] = -scale * (l11 + l21), rows[0][1] = scale * l11, rows[0][2] = scale * l21;
  rows[1][0] = -scale * l22, rows[1][1] = R(0), rows[1][2] = scale * l22;
  return 2;
}

/// An isotropic membrane made of linear triangles: E = A0 W(t, J) for each.
///
/// Law supplies `name`, `Params<R>`, `zero_at_rest`, `respond(t, J, params)` and `stiffness(params)`: the modulus
/// (uN/m) by which the law enters the quasi-Newton matrix. Any number of laws may share one strain of a triangle.
/// Source: constant-strain triangle in principal stretches, e.g. Charrier, Shrivastava & Wu 1989.
template <class ElasticLaw>
struct Membrane {
  using Law = ElasticLaw;
  static constexpr const char* name = Law::name;
  static constexpr int num_vertices = 3;
  static constexpr bool zero_at_rest = Law::zero_at_rest;

  template <class R>
  using Params = typename Law::template Params<R>;
  template <class R>
  using Rest = TriangleRest<R>;

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[3], const Params<R>&) {
    return triangle_rest(x);
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[3], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[3]) {
    const TriangleStrain<T> strain = triangle_strain(x, rest);
    const SurfaceResponse<T> w = Law::respond(strain.square_sum, strain.area_ratio, params);
    triangle_gradient(strain, rest, w, gradient);
    return rest.area * w.energy;
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, R (&rows)[2][3]) {
    return laplacian_rows(rest, Law::stiffness(params), rows);
  }
};

}  // namespace npfem
