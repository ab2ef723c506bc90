// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// Incompressible neo-Hookean sheet (Barthes-Biesel, Diaz & Dhenin 2002, eq. (2.6)):
///   W = (G_s/2) (t + 1/J^2 - 3).
/// Softens under strain. The law of most capsule benchmarks (there E_s = 3 G_s).
/// An area ratio below 1e-3 is treated as 1e-3, so that a collapsed triangle has a finite energy.
struct NeoHookean {
  static constexpr const char* name = "neo_hookean";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R shear_modulus;  ///< G_s, uN/m
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    const T inverse = R(1) / larger(area_ratio, T(R(1e-3)));
    const T inverse_square = inverse * inverse;
    return {R(0.5) * p.shear_modulus * (square_sum + inverse_square - R(3)), T(R(0.5) * p.shear_modulus),
            -p.shear_modulus * inverse * inverse_square};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return R(3) * p.shear_modulus;
  }
};

}  // namespace npfem
