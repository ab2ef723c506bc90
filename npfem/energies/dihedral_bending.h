// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/hinge.h"

namespace npfem {

/// Bending by signed dihedral angles (Kantor & Nelson 1987), weighted by the shape of the hinge:
///   E = k [1 - cos(theta - theta0)],   k = kappa L^2 / (A0 + A1).
/// L, A0, A1: rest edge length and triangle areas. On equilateral triangles k = (2/sqrt 3) kappa, Kantor and Nelson's
/// value. Hinge energies depend on the mesh: this one realises about 0.87 of the continuum kappa on subdivided
/// octahedra.
struct DihedralBending {
  static constexpr const char* name = "dihedral_bending";
  static constexpr int num_vertices = 4;
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R modulus;  ///< kappa, pN um (1e-18 J)
    R flat;     ///< 1: the rest angle is zero; 0: the angle of the rest shape
  };
  template <class R>
  struct Rest {
    R per_modulus;   ///< L^2 / (A0 + A1), 1
    R cosine, sine;  ///< of theta0
    HingeRow<R> row;
    R edge_length;  ///< L, um
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[4], const Params<R>& params) {
    const HingeAngle<R> angle = hinge_angle(x);
    return {angle.edge_length * angle.edge_length / hinge_area(x), select(params.flat > R(0), R(1), angle.cosine),
            select(params.flat > R(0), R(0), angle.sine), hinge_row(x), angle.edge_length};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[4], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[4]) {
    const HingeAngle<T> angle = hinge_angle(x);
    const R k = params.modulus * rest.per_modulus;
    const T cosine = rest.cosine * angle.cosine + rest.sine * angle.sine;  // of theta - theta0
    const T sine = rest.cosine * angle.sine - rest.sine * angle.cosine;
    const T moment = k * sine;  // dE/dtheta, pN um
    hinge_angle_gradient(x, angle, moment, gradient);
    return k * (R(1) - cosine);
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, R (&rows)[3][4]) {
    const R scale = square_root(params.modulus * rest.per_modulus) / rest.edge_length;
    for (int i = 0; i < 4; ++i) rows[0][i] = scale * rest.row.coefficient[i];
    return 1;
  }
};

}  // namespace npfem
