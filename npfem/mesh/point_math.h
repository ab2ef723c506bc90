// SPDX-License-Identifier: MPL-2.0
// The few vector operations that mesh code needs.
#pragma once

#include <cmath>

#include "mesh/triangle_mesh.h"

namespace npfem {

inline Point sum(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point scaled(double factor, const Point& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Point& a) {
  return std::sqrt(dot(a, a));
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the area of a triangle times its unit normal (outward where the triangle is counter-clockwise from outside).
inline Point area_vector(const TriangleMesh& mesh, const Triangle& t) {
  const Point& a = mesh.positions[static_cast<std::size_t>(t[0])];
  return cross(difference(mesh.positions[static_cast<std::size_t>(t[1])], a),
               difference(mesh.positions[static_cast<std::size_t>(t[2])], a));
}

}  // namespace npfem
