// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/hinge.h"

namespace npfem {

/// The lineage's `Bending`: quadratic hinge (Bergou et al. 2006) that remembers the magnitude of the rest curvature,
///   E = (w/2) 3/(A0 + A1) (|e| - clamp(|e|/n, least, largest) n)^2,   e = sum c_i x_i,  n = |e(rest)|.
/// Continuum modulus kappa_b = 3 w. Blind to the sign of the curvature, as in the lineage.
struct LineageBending {
  static constexpr const char* name = "lineage_bending";
  static constexpr int num_vertices = 4;
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R weight;   ///< w, pN um
    R least;    ///< smallest allowed |e|/n
    R largest;  ///< largest allowed |e|/n
  };
  template <class R>
  struct Rest {
    HingeRow<R> row;
    R per_area;   ///< 3/(A0 + A1), 1/um^2
    R magnitude;  ///< n, um
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[4], const Params<R>&) {
    const HingeRow<R> row = hinge_row(x);
    return {row, R(3) / hinge_area(x), norm(row.apply(x))};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[4], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[4]) {
    const R negligible = R(1e-6);  // um: below it the lineage takes a curvature as zero
    const Vec3<T> e = rest.row.apply(x);
    const T length = norm(e);
    const R n = larger(rest.magnitude, negligible);
    const T target = select(T(rest.magnitude) > T(negligible),
                            n * clamp(R(1) / n * length, T(params.least), T(params.largest)), T(R(0)));
    const T gap =
        select(length > T(negligible), length - target, select(T(rest.magnitude) > T(negligible), T(R(0)), length));
    const R stiffness = params.weight * rest.per_area;
    const T pull = stiffness * gap / larger(length, T(R(1e-30)));
    for (int i = 0; i < 4; ++i) gradient[i] = (rest.row.coefficient[i] * pull) * e;
    return R(0.5) * stiffness * gap * gap;
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, R (&rows)[3][4]) {
    const R scale = square_root(params.weight * rest.per_area);
    for (int i = 0; i < 4; ++i) rows[0][i] = scale * rest.row.coefficient[i];
    return 1;
  }
};

}  // namespace npfem
