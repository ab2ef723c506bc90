// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/singular_values.h"

namespace npfem {

/// How a solid answers a deformation gradient F: energy per rest volume and its derivative.
template <class T>
struct SolidResponse {
  T energy;           ///< W, Pa
  Matrix3<T> stress;  ///< dW/dF, Pa (first Piola-Kirchhoff)
};

template <class R>
struct TetrahedronRest {
  Vec3<R> inverse[3];  ///< rows of the inverse of the rest edges (x1 - x0, x2 - x0, x3 - x0), 1/um
  R volume;            ///< um^3
};

/// An isotropic solid made of linear tetrahedra: E = V0 W(F) for each.
///
/// Law supplies `name`, `Params<R>`, `respond(F, params)` and `stiffness(params)`: the modulus (Pa) by which the law
/// enters the quasi-Newton matrix.
template <class Law>
struct Tetrahedron {
  static constexpr const char* name = Law::name;
  static constexpr int num_vertices = 4;
  static constexpr bool zero_at_rest = true;

  template <class R>
  using Params = typename Law::template Params<R>;
  template <class R>
  using Rest = TetrahedronRest<R>;

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R> (&x)[4], const Params<R>&) {
    const Vec3<R> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
    const R determinant = dot(e1, cross(e2, e3)), inverse = R(1) / determinant;
    return {{inverse * cross(e2, e3), inverse * cross(e3, e1), inverse * cross(e1, e2)}, absolute(determinant) / R(6)};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&x)[4], const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T> (&gradient)[4]) {
    const Vec3<T> e[3] = {x[1] - x[0], x[2] - x[0], x[3] - x[0]};
    Matrix3<T> f;
    f.column[0] = rest.inverse[0].x * e[0] + rest.inverse[1].x * e[1] + rest.inverse[2].x * e[2];
    f.column[1] = rest.inverse[0].y * e[0] + rest.inverse[1].y * e[1] + rest.inverse[2].y * e[2];
    f.column[2] = rest.inverse[0].z * e[0] + rest.inverse[1].z * e[1] + rest.inverse[2].z * e[2];
    const SolidResponse<T> w = Law::respond(f, params);
    const Vec3<T>* p = w.stress.column;
    for (int i = 0; i < 3; ++i) {
      const Vec3<R> row = rest.volume * rest.inverse[i];
      gradient[i + 1] = row.x * p[0] + row.y * p[1] + row.z * p[2];
    }
    gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
    return rest.volume * w.energy;
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, R (&rows)[3][4]) {
    const R scale = square_root(Law::stiffness(params) * rest.volume);
    for (int i = 0; i < 3; ++i) {
      rows[0][i + 1] = scale * rest.inverse[i].x;
      rows[1][i + 1] = scale * rest.inverse[i].y;
      rows[2][i + 1] = scale * rest.inverse[i].z;
    }
    for (auto& row : rows) row[0] = -(row[1] + row[2] + row[3]);
    return 3;
  }
};

/// w/2 times the squared distance of the singular values from the place that `nearest` gives them, as a response.
template <class T, class R>
NPFEM_HD SolidResponse<T> distance_response(const SingularValues<T>& s, const T (&nearest)[3], const R& weight) {
  const T gap[3] = {s.value[0] - nearest[0], s.value[1] - nearest[1], s.value[2] - nearest[2]};
  const T slope[3] = {weight * gap[0], weight * gap[1], weight * gap[2]};
  return {R(0.5) * (slope[0] * gap[0] + slope[1] * gap[1] + slope[2] * gap[2]), s.matrix(slope)};
}

}  // namespace npfem
