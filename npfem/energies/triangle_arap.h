// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// As rigid as possible (Sorkine & Alexa 2007; Chao, Pinkall, Sanan & Schroeder 2010): distance of the triangle's
/// deformation to the nearest rotation,
///   W = (w/2) [(l1 - 1)^2 + (l2 - 1)^2] = (w/2) [t - 2 (l1 + l2) + 2],   (l1 + l2)^2 = t + 2 J.
/// Small-strain shear modulus w/2, area modulus w/2.
struct TriangleArap {
  static constexpr const char* name = "triangle_arap";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R weight;  ///< w, uN/m
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    const T sum = square_root(square_sum + R(2) * area_ratio);
    const T per_sum = R(1) / larger(sum, T(R(1e-30)));
    return {R(0.5) * p.weight * (square_sum - R(2) * sum + R(2)), R(0.5) * p.weight * (R(1) - per_sum),
            -p.weight * per_sum};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
