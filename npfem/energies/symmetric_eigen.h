// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// A symmetric 3 x 3 matrix by its upper triangle.
template <class T>
struct Symmetric3 {
  T xx, xy, xz, yy, yz, zz;
};

/// Eigenvalues from the largest to the smallest, with a right-handed set of orthonormal eigenvectors.
template <class T>
struct SymmetricEigen {
  T value[3];
  Vec3<T> vector[3];
};

template <class T>
NPFEM_HD Vec3<T> select_vector(const Vec3<T>& yes, const Vec3<T>& no, const T& a, const T& b) {
  return {select(a < b, yes.x, no.x), select(a < b, yes.y, no.y), select(a < b, yes.z, no.z)};
}

/// One Jacobi rotation (Golub & Van Loan, section 8.5): annihilates `coupling`, the entry (p, q). `other_p`, `other_q`
/// are the entries of p and q with the third axis.
template <class T>
NPFEM_HD void jacobi_rotate(T& pp, T& qq, T& coupling, T& other_p, T& other_q, Vec3<T>& axis_p, Vec3<T>& axis_q) {
  const T difference = qq - pp, twice = coupling + coupling;
  const T length = absolute(difference) + square_root(difference * difference + twice * twice);
  const T ratio = twice / larger(length, T(1e-30f));
  const T tangent = select(difference < T(0), -ratio, ratio);
  const T cosine = T(1) / square_root(T(1) + tangent * tangent), sine = tangent * cosine;
  pp = pp - tangent * coupling;
  qq = qq + tangent * coupling;
  coupling = T(0);
  const T rotated_p = cosine * other_p - sine * other_q;
  other_q = sine * other_p + cosine * other_q;
  other_p = rotated_p;
  const Vec3<T> rotated_axis = cosine * axis_p - sine * axis_q;
  axis_q = sine * axis_p + cosine * axis_q;
  axis_p = rotated_axis;
}

template <class T>
NPFEM_HD void order_pair(SymmetricEigen<T>& e, int i, int j) {
  const T a = e.value[i], b = e.value[j];
  const Vec3<T> va = e.vector[i], vb = e.vector[j];
  e.value[i] = select(a < b, b, a);
  e.value[j] = select(a < b, a, b);
  e.vector[i] = select_vector(vb, va, a, b);
  e.vector[j] = select_vector(va, vb, a, b);
}

/// Seven sweeps; each squares the error once it is small, and three to five reach round-off.
template <class T>
NPFEM_HD SymmetricEigen<T> symmetric_eigen(Symmetric3<T> a) {
  const T zero = T(0), one = T(1);
  SymmetricEigen<T> e{{zero, zero, zero}, {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
  for (int sweep = 0; sweep < 7; ++sweep) {
    jacobi_rotate(a.xx, a.yy, a.xy, a.xz, a.yz, e.vector[0], e.vector[1]);
    jacobi_rotate(a.xx, a.zz, a.xz, a.xy, a.yz, e.vector[0], e.vector[2]);
    jacobi_rotate(a.yy, a.zz, a.yz, a.xy, a.xz, e.vector[1], e.vector[2]);
  }
  e.value[0] = a.xx;
  e.value[1] = a.yy;
  e.value[2] = a.zz;
  order_pair(e, 0, 1);
  order_pair(e, 1, 2);
  order_pair(e, 0, 1);
  e.vector[2] = cross(e.vector[0], e.vector[1]);
  return e;
}

}  // namespace npfem
