// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// Yeoh's law for an incompressible sheet, as used for red cells by Mills et al. 2004 (Mech. Chem. Biosyst. 1, 169):
///   W = (G_s/2) k + c3 k^3,   k = t + 1/J^2 - 3.
/// Neo-Hookean at small strain, hardening beyond. An area ratio below 1e-3 is treated as 1e-3, so that a collapsed
/// triangle has a finite energy.
struct Yeoh {
  static constexpr const char* name = "yeoh";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R shear_modulus;  ///< G_s, uN/m
    R cubic;          ///< c3, uN/m
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    const T inverse = R(1) / larger(area_ratio, T(R(1e-3)));
    const T inverse_square = inverse * inverse;
    const T k = square_sum + inverse_square - R(3);
    const T slope = R(0.5) * p.shear_modulus + R(3) * p.cubic * k * k;  // dW/dk
    return {(R(0.5) * p.shear_modulus + p.cubic * k * k) * k, slope, R(-2) * slope * inverse * inverse_square};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return R(3) * p.shear_modulus;
  }
};

}  // namespace npfem
