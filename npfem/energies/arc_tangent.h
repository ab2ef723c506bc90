// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/number.h"

namespace npfem {

/// atan2(sine, cosine), the angle in [-pi, pi] of a vector of any length, from arithmetic and square roots alone, so
/// that a pack of lanes computes it like a single number. The angle is halved three times, after which |tan| is below
/// tan(pi/16) and eleven terms of the power series leave less than 1e-17. The angle of a zero vector is 0.
template <class T>
NPFEM_HD T arc_tangent(const T& sine, const T& cosine) {
  const T length = square_root(sine * sine + cosine * cosine);
  T tangent = sine / larger(length + absolute(cosine), T(1e-30f));
  for (int halving = 0; halving < 2; ++halving) {
    tangent = tangent / (T(1) + square_root(T(1) + tangent * tangent));
  }
  const T square = tangent * tangent;
  T series = T(1.0 / 21);
  for (int k = 19; k > 0; k -= 2) series = T(1.0 / k) - square * series;
  const T acute = T(8) * tangent * series;
  const T pi = T(3.14159265358979323846);
  return select(cosine < T(0), select(sine < T(0), -pi, pi) - acute, acute);
}

}  // namespace npfem
