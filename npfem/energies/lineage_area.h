// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/membrane.h"

namespace npfem {

/// The lineage's `Area`: distance to the nearest deformation whose area ratio lies in [least, largest] (both 1 in all
/// its files), a projective-dynamics energy (Bouaziz et al. 2014):
///   W = (w/2) [(l1 - s1)^2 + (l2 - s2)^2],   s = l moved along grad(s1 s2) until s1 s2 is in range.
/// Four Newton steps of that projection, as in the lineage: the gradient is exact to round-off up to strains of a few
/// per cent and to about 1e-6 at 20 %. Small-strain area modulus w/2.
struct LineageArea {
  static constexpr const char* name = "lineage_area";
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R weight;   ///< w, uN/m
    R least;    ///< smallest allowed area ratio
    R largest;  ///< largest allowed area ratio
  };

  template <class T, class R>
  NPFEM_HD static SurfaceResponse<T> respond(const T& square_sum, const T& area_ratio, const Params<R>& p) {
    // With l = (l1 + l2, l1 - l2) = (sum, difference), every iterate has the form (a, ratio * difference): the
    // iteration runs on a and ratio, and never divides by the difference, which may be zero.
    const T sum = square_root(square_sum + R(2) * area_ratio);
    const T difference_square = larger(square_sum - R(2) * area_ratio, T(R(0)));
    T a = sum, ratio = T(R(1));
    for (int iteration = 0; iteration < 4; ++iteration) {
      const T turned = ratio * difference_square;
      const T a_square = a * a, difference_part = ratio * turned;
      const T product = R(0.25) * (a_square - difference_part);
      const T excess = product - clamp(product, T(p.least), T(p.largest));
      // g = (s2, s1) has sum a and difference -ratio * difference: twice g . (s - l), and twice g . g.
      const T moved = (a - sum) * a - (difference_part - turned);
      const T length_square = a_square + difference_part;
      const T shift = (R(2) * excess - moved) / larger(length_square, T(R(1e-30)));
      const T next_a = sum - shift * a;
      ratio = R(1) + shift * ratio;
      a = next_a;
    }
    const T sum_gap = sum - a, ratio_gap = R(1) - ratio;
    const T energy = R(0.25) * p.weight * (sum_gap * sum_gap + ratio_gap * ratio_gap * difference_square);
    // The gradient of a distance to a set is the distance vector: dW = w (l - s) . dl.
    const T plus = p.weight * sum_gap * (R(1) / larger(sum, T(R(1e-30))));
    const T minus = p.weight * ratio_gap;
    return {energy, R(0.25) * (plus + minus), R(0.5) * (plus - minus)};
  }

  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.weight;
  }
};

}  // namespace npfem
