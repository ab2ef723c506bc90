// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// Keeps triangles from vanishing: nothing while J is above J0 = 0.4, below it
///   W = K (J0 - J)^3 / J,
/// twice continuously differentiable and without bound as J goes to 0. Elastic laws such as Skalak's give way under
/// compression and let a triangle collapse at a finite cost, as at the tips of red cells in strong shear; a real
/// membrane keeps its area within some per cent (K_A of 0.4 N/m, Evans, Waugh & Melnik 1976), so what this law stops is
/// the fault of the others. An area ratio below 1e-3 is treated as 1e-3.
struct CollapseBarrier {
  static constexpr const char* name = "collapse_barrier";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R modulus;  ///< K, uN/m
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& /*square_sum*/, const T& area_ratio, const Params<R>& p) {
    const T below = larger(R(0.4) - area_ratio, T(R(0)));
    const T inverse = R(1) / larger(area_ratio, T(R(1e-3)));
    const T slope = below * below * inverse;
    return {p.modulus * below * slope, T(R(0)), -p.modulus * slope * (R(3) + below * inverse)};
  }

  /// It does not act near rest.
  template <class R>
  static R stiffness(const Params<R>&) {
    return R(0);
  }
};

}  // namespace npfem
