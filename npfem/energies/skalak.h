// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// Skalak's law for red-cell membranes, in the form of Barthes-Biesel, Diaz & Dhenin 2002, eq. (2.8):
///   W = (G_s/4) [I1^2 + 2 I1 - 2 I2 + C I2^2],   I1 = t - 2,  I2 = J^2 - 1.
/// Hardens under strain; small-strain area modulus K = G_s (1 + 2C). (Skalak 1973 writes B = 2 G_s.)
struct Skalak {
  static constexpr const char* name = "skalak";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R shear_modulus;     ///< G_s, uN/m
    R area_coefficient;  ///< C, 1
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    const T i1 = square_sum - R(2);
    const T i2 = area_ratio * area_ratio - R(1);
    return {R(0.25) * p.shear_modulus * (i1 * i1 + R(2) * (i1 - i2) + p.area_coefficient * i2 * i2),
            R(0.5) * p.shear_modulus * (i1 + R(1)), p.shear_modulus * area_ratio * (p.area_coefficient * i2 - R(1))};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.shear_modulus * (R(2) + p.area_coefficient);
  }
};

}  // namespace npfem
