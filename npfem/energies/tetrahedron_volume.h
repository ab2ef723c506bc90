// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/tetrahedron.h"

namespace npfem {

/// The lineage's `Volume`: distance to the nearest deformation whose volume ratio lies in [least, largest]
/// (Bouaziz et al. 2014, section 5.1):
///   W = (w/2) |l - s|^2,   s = l moved along grad(s1 s2 s3) until s1 s2 s3 is in range.
/// Four Newton steps of that projection, as in the lineage: exact to round-off up to strains of a few per cent.
struct TetrahedronVolume {
  static constexpr const char* name = "tetrahedron_volume";

  template <class R>
  struct Params {
    R weight;          ///< w, Pa
    R least, largest;  ///< volume ratio, 1
  };

  template <class T, class R>
  NPFEM_HD static SolidResponse<T> respond(const Matrix3<T>& f, const Params<R>& p) {
    const SingularValues<T> l = singular_values(f);
    T s[3] = {l.value[0], l.value[1], l.value[2]};
    for (int iteration = 0; iteration < 4; ++iteration) {
      const T g[3] = {s[1] * s[2], s[0] * s[2], s[0] * s[1]};
      const T product = s[0] * g[0];
      const T excess = product - clamp(product, T(p.least), T(p.largest));
      T moved = T(R(0)), square = T(R(0));
      for (int i = 0; i < 3; ++i) {
        moved = moved + g[i] * (s[i] - l.value[i]);
        square = square + g[i] * g[i];
      }
      const T shift = (excess - moved) / larger(square, T(R(1e-30)));
      for (int i = 0; i < 3; ++i) s[i] = l.value[i] - shift * g[i];
    }
    return distance_response(l, s, p.weight);
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
