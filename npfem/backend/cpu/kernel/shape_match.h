// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/cell_fields.h"
#include "backend/cpu/kernel/rotation.h"

namespace npfem::NPFEM_ISA {

/// How the cells are turned against the shape at rest, and how little they resemble it.
template <class P>
struct ShapeMatch {
  Matrix3<P> rotation;
  P not_orthogonal;  ///< square departure of `rotation` from an orthogonal matrix: large where none was found
  P strain_square;   ///< mean square distance to the turned shape at rest, over its mean square size
};

/// `position`: about each cell's centre; `rest_shape`: xyzxyz..., about its own. The rotation is that of the polar
/// decomposition of sum x X^T.
template <class Shape, class R>
ShapeMatch<typename Shape::P> match_shape(const typename Shape::P* position, const double* rest_shape, int n) {
  using P = typename Shape::P;
  using Fields = CellFields<Shape, R>;
  constexpr int cells = Shape::cells;

  R moment[3][3][cells] = {};
  for (int i = 0; i < n; ++i) {
    for (int a = 0; a < 3; ++a) {
      const R* const x = Fields::row(position, 3 * i + a);
      for (int b = 0; b < 3; ++b) {
        const R rest = static_cast<R>(rest_shape[3 * i + b]);
        for (int l = 0; l < cells; ++l) moment[a][b][l] += x[l] * rest;
      }
    }
  }
  Matrix3<P> m;
  for (int a = 0; a < 3; ++a) {
    P* const row[3] = {&m.row[a].x, &m.row[a].y, &m.row[a].z};
    for (int b = 0; b < 3; ++b) {
      for (int l = 0; l < Shape::lanes; ++l) row[b]->set(l, moment[a][b][cells == 1 ? 0 : l]);
    }
  }
  ShapeMatch<P> match;
  match.rotation = orthogonal_factor<R>(m, match.not_orthogonal);

  R q[3][3][cells], distance[cells] = {}, size = 0;
  for (int a = 0; a < 3; ++a) {
    const P* const row[3] = {&match.rotation.row[a].x, &match.rotation.row[a].y, &match.rotation.row[a].z};
    for (int b = 0; b < 3; ++b) {
      for (int l = 0; l < cells; ++l) q[a][b][l] = (*row[b])[l];
    }
  }
  for (int i = 0; i < n; ++i) {
    const R x = static_cast<R>(rest_shape[3 * i]), y = static_cast<R>(rest_shape[3 * i + 1]),
            z = static_cast<R>(rest_shape[3 * i + 2]);
    size += x * x + y * y + z * z;
    for (int a = 0; a < 3; ++a) {
      const R* const at = Fields::row(position, 3 * i + a);
      for (int l = 0; l < cells; ++l) {
        const R gap = at[l] - (q[a][0][l] * x + q[a][1][l] * y + q[a][2][l] * z);
        distance[l] += gap * gap;
      }
    }
  }
  for (int l = 0; l < Shape::lanes; ++l) match.strain_square.set(l, distance[cells == 1 ? 0 : l] / size);
  return match;
}

}  // namespace npfem::NPFEM_ISA
