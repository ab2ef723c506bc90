// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/tetrahedron.h"

namespace npfem {

/// As rigid as possible (Sorkine & Alexa 2007; Chao, Pinkall, Sanan & Schroeder 2010): distance of F to the nearest
/// rotation, W = (w/2) |F - R|^2 = (w/2) sum_i (l_i - 1)^2. Small-strain shear modulus w/2, Poisson's ratio 0.
struct TetrahedronArap {
  static constexpr const char* name = "tetrahedron_arap";

  template <class R>
  struct Params {
    R weight;  ///< w, Pa
  };

  template <class T, class R>
  NPFEM_HD static SolidResponse<T> respond(const Matrix3<T>& f, const Params<R>& p) {
    const T rotation[3] = {T(R(1)), T(R(1)), T(R(1))};
    return distance_response(singular_values(f), rotation, p.weight);
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
