// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// Limits the principal stretches of a triangle to [least, largest], a projective-dynamics energy (Bouaziz et al. 2014,
/// section 5.1): W = (w/2) [(l1 - clamp(l1))^2 + (l2 - clamp(l2))^2]. Free within the range.
struct TriangleStrainLimit {
  static constexpr const char* name = "triangle_strain_limit";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R weight;          ///< w, uN/m
    R least, largest;  ///< stretch, 1
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    const T sum = square_root(square_sum + R(2) * area_ratio);                          // l1 + l2
    const T difference = square_root(larger(square_sum - R(2) * area_ratio, T(R(0))));  // l1 - l2
    const T l1 = R(0.5) * (sum + difference), l2 = R(0.5) * (sum - difference);
    const T gap1 = l1 - clamp(l1, T(p.least), T(p.largest)), gap2 = l2 - clamp(l2, T(p.least), T(p.largest));
    // dW = w (gap1 dl1 + gap2 dl2); where the stretches are equal their difference pulls nowhere.
    const T tiny = T(R(1e-30));
    const T plus = p.weight * (gap1 + gap2) / larger(sum, tiny);
    const T minus = p.weight * (gap1 - gap2) / larger(difference, tiny);
    return {R(0.5) * p.weight * (gap1 * gap1 + gap2 * gap2), R(0.25) * (plus + minus), R(0.5) * (plus - minus)};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
