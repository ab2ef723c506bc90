// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// Keeps the angle at x[0] between p = x[1] - x[0] and q = x[2] - x[0] within a range (Bouaziz et al. 2012):
///   E = (w/2) (|p - p'|^2 + |q - q'|^2),   p', q' the nearest pair within it.
/// A pair that misses the range by an angle D turns by D in all, each vector being projected on its new direction:
///   |p - p'|^2 + |q - q'|^2 = (P + Q - sqrt(P^2 + Q^2 + 2 P Q cos 2D))/2,   P = |p|^2, Q = |q|^2,  D up to 90 degrees.
struct AngleRange {
  static constexpr const char* name = "angle";
  static constexpr int num_vertices = 3;
  static constexpr bool zero_at_rest = false;

  template <class R>
  struct Params {
    R weight;             ///< w, pN/um
    R cosine_of_least;    ///< of the smallest allowed angle
    R cosine_of_largest;  ///< of the largest allowed angle
  };
  template <class R>
  struct Rest {
    R size_square;  ///< |p|^2 + |q|^2, um^2: the measure of what is small
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[3], const Params<R>&) {
    return {dot(x[1] - x[0], x[1] - x[0]) + dot(x[2] - x[0], x[2] - x[0])};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[3], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[3]) {
    const Vec3<T> p = x[1] - x[0], q = x[2] - x[0];
    const T tiny = T(R(1e-30)), zero = T(R(0)), p2 = dot(p, p), q2 = dot(q, q);
    const T length_p = larger(square_root(p2), tiny), length_q = larger(square_root(q2), tiny);
    const Vec3<T> unit_p = (R(1) / length_p) * p, unit_q = (R(1) / length_q) * q;
    const T cosine = dot(unit_p, unit_q), sine = norm(cross(unit_p, unit_q));

    // The nearest angle of the range, and cosine and sine of what is missing to it (both 0 or positive).
    const T limit_cosine = clamp(cosine, T(params.cosine_of_largest), T(params.cosine_of_least));
    const T limit_sine = square_root(larger(R(1) - limit_cosine * limit_cosine, zero));
    const T outside = absolute(cosine - limit_cosine);
    const T miss_cosine = select(zero < outside, larger(cosine * limit_cosine + sine * limit_sine, zero), T(R(1)));
    const T miss_sine = select(zero < outside, absolute(sine * limit_cosine - cosine * limit_sine), zero);

    const T root = square_root((p2 - q2) * (p2 - q2) + R(4) * p2 * q2 * miss_cosine * miss_cosine);
    const T bounded = larger(root, T(R(1e-9) * rest.size_square));
    const R half_weight = R(0.5) * params.weight;
    // E = half_weight (P + Q - root)/2, where P + Q - root = 4 P Q sin^2 D/(P + Q + root) keeps its digits.
    const T energy = half_weight * R(2) * p2 * q2 * (R(1) - miss_cosine * miss_cosine) / larger(p2 + q2 + root, tiny);
    const T by_p2 = half_weight * R(0.5) * (R(1) - (p2 - q2 + R(2) * q2 * miss_cosine * miss_cosine) / bounded);
    const T by_q2 = half_weight * R(0.5) * (R(1) - (q2 - p2 + R(2) * p2 * miss_cosine * miss_cosine) / bounded);
    // Opening the angle closes the miss below the range and widens it above.
    const T by_miss = half_weight * R(2) * p2 * q2 * miss_cosine * miss_sine / bounded;
    const T by_angle = select(limit_cosine < cosine, -by_miss, by_miss);
    const Vec3<T> open_p = (R(1) / (length_p * larger(sine, T(R(1e-9))))) * (cosine * unit_p - unit_q);
    const Vec3<T> open_q = (R(1) / (length_q * larger(sine, T(R(1e-9))))) * (cosine * unit_q - unit_p);
    gradient[1] = (R(2) * by_p2) * p + by_angle * open_p;
    gradient[2] = (R(2) * by_q2) * q + by_angle * open_q;
    gradient[0] = -(gradient[1] + gradient[2]);
    return energy;
  }

  template <class R>
  static int weight_rows(const Rest<R>&, const Params<R>& params, R (&rows)[2][3]) {
    const R scale = square_root(params.weight);
    rows[0][0] = -scale, rows[0][1] = scale, rows[0][2] = R(0);
    rows[1][0] = -scale, rows[1][1] = R(0), rows[1][2] = scale;
    return 2;
  }
};

}  // namespace npfem
