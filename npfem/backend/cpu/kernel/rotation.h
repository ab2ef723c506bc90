// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/pack.h"

namespace npfem::NPFEM_ISA {

template <class P>
struct Matrix3 {
  Vec3<P> row[3];
};

template <class P>
NPFEM_LANES_INLINE Vec3<P> times(const Matrix3<P>& m, const Vec3<P>& v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
template <class P>
NPFEM_LANES_INLINE Vec3<P> transposed_times(const Matrix3<P>& m, const Vec3<P>& v) {
  return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2];
}
template <class P>
NPFEM_LANES_INLINE P norm_square(const Matrix3<P>& m) {
  return dot(m.row[0], m.row[0]) + dot(m.row[1], m.row[1]) + dot(m.row[2], m.row[2]);
}

/// The orthogonal factor of m = Q S, by Newton's iteration with Frobenius scaling (Higham 1986, "Computing the polar
/// decomposition"). `orthogonal` tells the lanes in which it converged; a flat cloud of points has no orientation.
template <class R, class P>
NPFEM_LANES_INLINE Matrix3<P> orthogonal_factor(Matrix3<P> m, P& departure) {
  for (int iteration = 0; iteration < 9; ++iteration) {
    // The rows of det(m) m^-T are the cross products of the rows of m.
    const Matrix3<P> cofactors{{cross(m.row[1], m.row[2]), cross(m.row[2], m.row[0]), cross(m.row[0], m.row[1])}};
    const P determinant = dot(m.row[0], cofactors.row[0]);
    const P tiny(R(1e-30));
    const P size =
        select(determinant < P(R(0)), P(R(0)) - larger(P(R(0)) - determinant, tiny), larger(determinant, tiny));
    const P inverse_determinant = P(R(1)) / size;
    const P inverse_norm = square_root(norm_square(cofactors)) * magnitude(inverse_determinant);
    const P scale = square_root(inverse_norm / larger(square_root(norm_square(m)), tiny));
    const P a = R(0.5) * scale, b = R(0.5) * inverse_determinant / larger(scale, tiny);
    for (int r = 0; r < 3; ++r) m.row[r] = a * m.row[r] + b * cofactors.row[r];
  }
  const P xx = dot(m.row[0], m.row[0]) - P(R(1)), yy = dot(m.row[1], m.row[1]) - P(R(1)),
          zz = dot(m.row[2], m.row[2]) - P(R(1)), xy = dot(m.row[0], m.row[1]), yz = dot(m.row[1], m.row[2]),
          zx = dot(m.row[2], m.row[0]);
  departure = xx * xx + yy * yy + zz * zz + xy * xy + yz * yz + zx * zx;
  return m;
}

}  // namespace npfem::NPFEM_ISA
