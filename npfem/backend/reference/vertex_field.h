// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/Core>

#include "energies/vec3.h"

namespace npfem {

/// A vector at every vertex of one cell; memory order xyzxyz...
using VertexField = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

inline Vec3<double> at(const VertexField& field, int vertex) {
  return {field(vertex, 0), field(vertex, 1), field(vertex, 2)};
}

inline void add_to(VertexField& field, int vertex, const Vec3<double>& value) {
  field(vertex, 0) += value.x;
  field(vertex, 1) += value.y;
  field(vertex, 2) += value.z;
}

/// Sum over vertices of the scalar products.
inline double inner(const VertexField& a, const VertexField& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace npfem
