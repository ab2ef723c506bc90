// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/number.h"

namespace npfem {

/// A point or vector in space over any number type: double, float, or a pack of lanes.
template <class T>
struct Vec3 {
  T x, y, z;
};

template <class T>
NPFEM_HD Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
NPFEM_HD Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
NPFEM_HD Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class S, class T>
NPFEM_HD Vec3<T> operator*(const S& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
NPFEM_HD T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
NPFEM_HD Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
NPFEM_HD T norm(const Vec3<T>& a) {
  return square_root(dot(a, a));
}

}  // namespace npfem
