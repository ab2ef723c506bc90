// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/tetrahedron.h"

namespace npfem {

/// Neo-Hookean solid in the form that is at rest and finite everywhere, also inverted (Smith, de Goes & Kim 2018,
/// eq. 13, without their logarithmic term, which only matters for a fully collapsed element):
///   W = (mu/2) (|F|^2 - 3) - mu (J - 1) + (lambda/2) (J - 1)^2,   lambda = K + mu/3,
/// so that mu and K are shear and bulk modulus at small strain.
struct NeoHookeanSolid {
  static constexpr const char* name = "neo_hookean_solid";

  template <class R>
  struct Params {
    R shear_modulus;  ///< mu, Pa
    R bulk_modulus;   ///< K, Pa
  };

  template <class T, class R>
  NPFEM_HD static SolidResponse<T> respond(const Matrix3<T>& f, const Params<R>& p) {
    const Vec3<T>* c = f.column;
    const Vec3<T> cofactor[3] = {cross(c[1], c[2]), cross(c[2], c[0]), cross(c[0], c[1])};  // dJ/dF
    const T strain = dot(c[0], cofactor[0]) - R(1);
    const T square = dot(c[0], c[0]) + dot(c[1], c[1]) + dot(c[2], c[2]);
    const R lambda = p.bulk_modulus + p.shear_modulus / R(3);
    const T by_volume = lambda * strain - p.shear_modulus;
    SolidResponse<T> w;
    w.energy = R(0.5) * p.shear_modulus * (square - R(3)) + (R(0.5) * lambda * strain - p.shear_modulus) * strain;
    for (int i = 0; i < 3; ++i) w.stress.column[i] = p.shear_modulus * c[i] + by_volume * cofactor[i];
    return w;
  }

  /// Modulus of a plane compression wave.
  template <class R>
  static R stiffness(const Params<R>& p) {
    return p.bulk_modulus + R(4) / R(3) * p.shear_modulus;
  }
};

}  // namespace npfem
