// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// The lineage's `SurfaceMaterial`: separable in the principal stretches (Valanis-Landel), without an area term,
///   W = 1/2 [f(l1) + f(l2)],   f(l) = (mu/4)(l - 1)^4 + (Lambda/8) l^4 - (Lambda/4) l^2.
/// Small-strain shear modulus Lambda/4; the mu part hardens it. W(rest) = -Lambda/8: the lineage stops its iterations
/// on the scatter of the energy relative to its mean, and this offset is part of that mean.
struct LineageSurfaceMaterial {
  static constexpr const char* name = "lineage_surface_material";
  static constexpr bool zero_at_rest = false;

  template <class R>
  struct Params {
    R mu;      ///< uN/m
    R lambda;  ///< uN/m
    R weight;  ///< uN/m, enters the quasi-Newton matrix only
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    // All sums over the two stretches are polynomials in their sum s and product J; so is the divided difference
    // (f'(l1) - f'(l2)) / (l1 - l2), which is why equal stretches need no special case.
    const T sum = square_root(square_sum + R(2) * area_ratio);
    const T square_sum_below = (sum - R(2)) * (sum - R(2)) - R(2) * (area_ratio - sum + R(1));  // sum of (l - 1)^2
    const T product_below = area_ratio - sum + R(1);                                            // (l1 - 1)(l2 - 1)
    const T cube_sum_below = (sum - R(2)) * (square_sum_below - product_below);                 // sum of (l - 1)^3
    const T fourth_sum_below = square_sum_below * square_sum_below - R(2) * product_below * product_below;
    const T fourth_sum = square_sum * square_sum - R(2) * area_ratio * area_ratio;
    const T cube_sum = sum * (square_sum - area_ratio);

    const T energy = R(0.5) * (R(0.25) * p.mu * fourth_sum_below + R(0.125) * p.lambda * fourth_sum -
                               R(0.25) * p.lambda * square_sum);
    const T slope_sum = p.mu * cube_sum_below + R(0.5) * p.lambda * (cube_sum - sum);
    const T slope_difference =
        p.mu * (square_sum_below + product_below) + R(0.5) * p.lambda * (square_sum + area_ratio - R(1));
    // dW = 1/2 [f'(l1) dl1 + f'(l2) dl2] = alpha dt/2 + beta dJ with
    // alpha + beta = slope_sum / (2 s), alpha - beta = slope_difference / 2.
    const T plus = R(0.5) * slope_sum * (R(1) / larger(sum, T(R(1e-30))));
    const T minus = R(0.5) * slope_difference;
    return {energy, R(0.25) * (plus + minus), R(0.5) * (plus - minus)};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
