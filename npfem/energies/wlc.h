// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// An edge of the spectrin network: worm-like chain and power-law repulsion of exponent 2
/// (Fedosov, Caswell & Karniadakis, Biophys. J. 98 (2010) 2215, eqs. 3 to 6 and 11), up to its constant:
///   E = (B l_max/4) (3 x^2 - 2 x^3)/(1 - x) + k_p/l,   x = l/l_max.
/// Every edge rests at its own length l0 = x0 l_max: k_p = B phi l0^2 with phi = 1/(4 (1 - x0)^2) - 1/4 + x0. The
/// chain's force scale B = k_B T/p follows from the shear modulus of the network of equilateral triangles,
///   mu0 = (sqrt 3/4) B/l0 [x0/(2 (1 - x0)^3) + x0 + 2 phi];
/// its area modulus is 2 mu0. Below 5 % of l0 and beyond 97 % of l_max the energy goes on as its own parabola, so that
/// it is finite for any length.
struct WormLikeChain {
  static constexpr const char* name = "wlc";
  static constexpr int num_vertices = 2;
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R shear_modulus;  ///< mu0, uN/m
    R rest_ratio;     ///< x0 = l0/l_max, above 0, below 0.97
  };
  template <class R>
  struct Rest {
    R length;       ///< l0, um
    R longest;      ///< l_max, um
    R chain_force;  ///< B, pN
    R repulsion;    ///< k_p, pN um^2
    R energy;       ///< of the rest length, pN um
    R stiffness;    ///< d2E/dl2 at rest, pN/um
  };

  /// Energy of an edge and its first two derivatives by length.
  template <class T>
  struct Spring {
    T energy, force, stiffness;  ///< pN um, pN, pN/um
  };
  template <class T, class R>
  NPFEM_HD static Spring<T> spring(const T& length, const Rest<R>& rest) {
    const T x = length / rest.longest, inverse = R(1) / length;
    const T open = R(1) / (R(1) - x), open_square = open * open;
    const R chain = R(0.25) * rest.chain_force;
    const T repulsion = rest.repulsion * inverse;
    return {chain * rest.longest * x * x * (R(3) - R(2) * x) * open + repulsion,
            chain * (open_square - R(1) + R(4) * x) - repulsion * inverse,
            chain / rest.longest * (R(2) * open * open_square + R(4)) + R(2) * repulsion * inverse * inverse};
  }

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[2], const Params<R>& params) {
    const R x0 = params.rest_ratio, open = R(1) / (R(1) - x0);
    const R phi = R(0.25) * open * open - R(0.25) + x0;
    Rest<R> rest;
    rest.length = norm(x[1] - x[0]);
    rest.longest = rest.length / x0;
    rest.chain_force = R(4) * params.shear_modulus * rest.length /
                       (square_root(R(3)) * (R(0.5) * x0 * open * open * open + x0 + R(2) * phi));
    rest.repulsion = rest.chain_force * phi * rest.length * rest.length;
    const Spring<R> at_rest = spring(rest.length, rest);
    rest.energy = at_rest.energy;
    rest.stiffness = at_rest.stiffness;
    return rest;
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[2], const Rest<R>& rest, const Params<R>& /*params*/,
                                    Vec3<T> (&gradient)[2]) {
    const Vec3<T> edge = x[1] - x[0];
    const T length = norm(edge);
    const T inside = clamp(length, T(R(0.05) * rest.length), T(R(0.97) * rest.longest));
    const T outside = length - inside;
    const Spring<T> s = spring(inside, rest);
    const T force = s.force + s.stiffness * outside;
    gradient[1] = (force / larger(length, T(R(1e-30)))) * edge;
    gradient[0] = -gradient[1];
    return s.energy - rest.energy + (s.force + R(0.5) * s.stiffness * outside) * outside;
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& /*params*/, R (&rows)[1][2]) {
    rows[0][1] = square_root(rest.stiffness);
    rows[0][0] = -rows[0][1];
    return 1;
  }
};

}  // namespace npfem
