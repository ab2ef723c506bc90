// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/symmetric_eigen.h"

namespace npfem {

/// Draws a group of points to a kind of shape, wherever and however large it lies best (Bouaziz, Deuss, Schwartzburg,
/// Weise & Pauly, "Shape-Up", 2012; projective energies: Bouaziz et al. 2014):
///   E = (w/2) sum_i |x_i - P_i|^2,   P: the nearest points that lie on such a shape.
/// It is at rest where the points lie on one, whatever shape they had before.
///
/// Law supplies `name`, `Params<R>` with a `weight`, `Rest<R>`, `rest(d, count, params)` and `respond(d, count, rest,
/// params, gradient)`, where d are the points from their centre: returns E (pN um), writes dE/dd (pN).
template <class Law>
struct FittedShape {
  static constexpr const char* name = Law::name;
  static constexpr int max_vertices = 32;
  static constexpr bool zero_at_rest = false;

  template <class R>
  using Params = typename Law::template Params<R>;
  template <class R>
  using Rest = typename Law::template Rest<R>;

  template <class T>
  NPFEM_HD static void from_centre(const Vec3<T>* x, int count, Vec3<T>* d) {
    Vec3<T> sum{T(0), T(0), T(0)};
    for (int i = 0; i < count; ++i) sum = sum + (x[i] - x[0]);
    const Vec3<T> centre = x[0] + (T(1) / T(static_cast<float>(count))) * sum;
    for (int i = 0; i < count; ++i) d[i] = x[i] - centre;
  }

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* x, int count, const Params<R>& params) {
    Vec3<R> d[max_vertices];
    from_centre(x, count, d);
    return Law::rest(d, count, params);
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T>* x, int count, const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T>* gradient) {
    Vec3<T> d[max_vertices];
    from_centre(x, count, d);
    return Law::respond(d, count, rest, params, gradient);
  }

  /// A point cannot move by more than its distance: w |x_i - centre|^2 bounds the energy.
  template <class R>
  static int weight_rows(const Rest<R>&, const Params<R>& params, int count, R (*rows)[max_vertices]) {
    const R weight = square_root(params.weight), share = weight / R(count);
    for (int r = 0; r < count; ++r) {
      for (int i = 0; i < count; ++i) rows[r][i] = (i == r ? weight : R(0)) - share;
    }
    return count;
  }
};

/// Parameters and rest shape of the laws that remember nothing but a size.
template <class R>
struct ShapeParams {
  R weight;  ///< w, pN/um
};
template <class R>
struct ShapeRest {
  R size_square;  ///< mean square distance from the centre, um^2: the measure of what is small
};

template <class R>
NPFEM_HD ShapeRest<R> shape_rest(const Vec3<R>* d, int count) {
  R sum = R(0);
  for (int i = 0; i < count; ++i) sum += dot(d[i], d[i]);
  return {sum / R(count)};
}

/// What those laws share: `struct PlaneShape : SizedShape`.
struct SizedShape {
  template <class R>
  using Params = ShapeParams<R>;
  template <class R>
  using Rest = ShapeRest<R>;

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* d, int count, const Params<R>&) {
    return shape_rest(d, count);
  }
};

/// sum_i d_i d_i^T, um^2.
template <class T>
NPFEM_HD Symmetric3<T> second_moment(const Vec3<T>* d, int count) {
  Symmetric3<T> m{T(0), T(0), T(0), T(0), T(0), T(0)};
  for (int i = 0; i < count; ++i) {
    m.xx = m.xx + d[i].x * d[i].x;
    m.xy = m.xy + d[i].x * d[i].y;
    m.xz = m.xz + d[i].x * d[i].z;
    m.yy = m.yy + d[i].y * d[i].y;
    m.yz = m.yz + d[i].y * d[i].z;
    m.zz = m.zz + d[i].z * d[i].z;
  }
  return m;
}

}  // namespace npfem
