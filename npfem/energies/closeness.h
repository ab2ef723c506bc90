// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// A spring from a vertex to a fixed point: E = (w/2) |x - target|^2. The one energy that feels a translation: it takes
/// up a net force.
struct Closeness {
  static constexpr const char* name = "closeness";
  static constexpr int num_vertices = 1;
  static constexpr bool zero_at_rest = true;
  static constexpr bool translation_invariant = false;

  template <class R>
  struct Params {
    R weight;  ///< w, pN/um
  };
  template <class R>
  struct Rest {
    Vec3<R> target;  ///< the vertex's place at rest, um
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[1], const Params<R>&) {
    return {x[0]};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[1], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[1]) {
    const Vec3<T> gap{x[0].x - rest.target.x, x[0].y - rest.target.y, x[0].z - rest.target.z};
    gradient[0] = params.weight * gap;
    return R(0.5) * params.weight * dot(gap, gap);
  }

  template <class R>
  static int weight_rows(const Rest<R>&, const Params<R>& params, R (&rows)[1][1]) {
    rows[0][0] = square_root(params.weight);
    return 1;
  }
};

}  // namespace npfem
