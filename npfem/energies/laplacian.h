// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// Smoothness of a vertex x[0] among its neighbours (Bouaziz et al. 2012): L = x[0] - mean of the neighbours,
///   E = (w/2) (|L| - n)^2,   n = |L| at rest, or 0, which draws the vertex into the middle of its neighbours.
struct Laplacian {
  static constexpr const char* name = "laplacian";
  static constexpr int max_vertices = 32;
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R weight;  ///< w, pN/um
    R flat;    ///< 1: n = 0; 0: n as at rest
  };
  template <class R>
  struct Rest {
    R length;  ///< n, um
  };

  template <class T>
  NPFEM_HD static Vec3<T> bump(const Vec3<T>* x, int count) {
    Vec3<T> sum{T(0), T(0), T(0)};
    for (int i = 1; i < count; ++i) sum = sum + (x[0] - x[i]);
    return (T(1) / T(static_cast<float>(count - 1))) * sum;
  }

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* x, int count, const Params<R>& params) {
    return {select(params.flat > R(0), R(0), norm(bump(x, count)))};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T>* x, int count, const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T>* gradient) {
    const Vec3<T> l = bump(x, count);
    const T length = norm(l), gap = length - rest.length;
    const T share = T(R(-1)) / T(static_cast<float>(count - 1));
    gradient[0] = (params.weight * gap / larger(length, T(R(1e-30)))) * l;
    for (int i = 1; i < count; ++i) gradient[i] = share * gradient[0];
    return R(0.5) * params.weight * gap * gap;
  }

  template <class R>
  static int weight_rows(const Rest<R>&, const Params<R>& params, int count, R (*rows)[max_vertices]) {
    rows[0][0] = square_root(params.weight);
    for (int i = 1; i < count; ++i) rows[0][i] = -rows[0][0] / R(count - 1);
    return 1;
  }
};

}  // namespace npfem
