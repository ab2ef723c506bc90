// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// Limits the stretch of an edge to [least, largest], a projective-dynamics energy (Bouaziz et al. 2014, section 5.1):
///   E = (w/2) l0 (s - clamp(s))^2,   s = l/l0.
/// Free within the range.
struct EdgeStrainLimit {
  static constexpr const char* name = "edge_strain_limit";
  static constexpr int num_vertices = 2;
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R weight;          ///< w, pN
    R least, largest;  ///< stretch, 1
  };
  template <class R>
  struct Rest {
    R length;  ///< l0, um
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[2], const Params<R>&) {
    return {norm(x[1] - x[0])};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[2], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[2]) {
    const Vec3<T> edge = x[1] - x[0];
    const T length = norm(edge), stretch = length / rest.length;
    const T gap = stretch - clamp(stretch, T(params.least), T(params.largest));
    gradient[1] = (params.weight * gap / larger(length, T(R(1e-30)))) * edge;
    gradient[0] = -gradient[1];
    return R(0.5) * params.weight * rest.length * gap * gap;
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, R (&rows)[1][2]) {
    rows[0][1] = square_root(params.weight / rest.length);
    rows[0][0] = -rows[0][1];
    return 1;
  }
};

}  // namespace npfem
