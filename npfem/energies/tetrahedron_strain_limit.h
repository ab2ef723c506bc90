// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/tetrahedron.h"

namespace npfem {

/// Limits the principal stretches of a tetrahedron to [least, largest], a projective-dynamics energy (Bouaziz et al.
/// 2014, section 5.1): W = (w/2) sum_i (l_i - clamp(l_i))^2. Free within the range; an inverted tetrahedron is outside
/// of it and is turned back.
struct TetrahedronStrainLimit {
  static constexpr const char* name = "tetrahedron_strain_limit";

  template <class R>
  struct Params {
    R weight;          ///< w, Pa
    R least, largest;  ///< stretch, 1
  };

  template <class T, class R>
  NPFEM_HD static SolidResponse<T> respond(const Matrix3<T>& f, const Params<R>& p) {
    const SingularValues<T> s = singular_values(f);
    T nearest[3];
    for (int i = 0; i < 3; ++i) nearest[i] = clamp(s.value[i], T(p.least), T(p.largest));
    return distance_response(s, nearest, p.weight);
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
