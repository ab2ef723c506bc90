// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// Local area: W = (K_L/2) (J - 1)^2. Small-strain area modulus K_L, no resistance to shear.
struct LocalArea {
  static constexpr const char* name = "local_area";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R modulus;  ///< K_L, uN/m
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& /*square_sum*/, const T& area_ratio, const Params<R>& p) {
    const T strain = area_ratio - R(1);
    return {R(0.5) * p.modulus * strain * strain, T(R(0)), p.modulus * strain};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.modulus;
  }
};

}  // namespace npfem
