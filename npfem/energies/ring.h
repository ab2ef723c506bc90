// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

// A ring is a vertex x[0] and its neighbours x[1] ... x[count - 1], counter-clockwise seen from outside; its triangles
// are (0, i, i + 1), the last one (0, count - 1, 1).

inline constexpr int max_ring_vertices = 32;

NPFEM_HD constexpr int next_in_ring(int i, int count) {
  return i + 1 < count ? i + 1 : 1;
}
NPFEM_HD constexpr int previous_in_ring(int i, int count) {
  return i > 1 ? i - 1 : count - 1;
}

/// Area that belongs to the vertex: one third of its triangles, um^2. Writes dA/dx (um).
template <class T>
NPFEM_HD T ring_area(const Vec3<T>* x, int count, Vec3<T>* gradient) {
  const T share = T(1) / T(6);
  T area = T(0);
  for (int i = 0; i < count; ++i) gradient[i] = {T(0), T(0), T(0)};
  for (int i = 1; i < count; ++i) {
    const int j = next_in_ring(i, count);
    const Vec3<T> e1 = x[i] - x[0], e2 = x[j] - x[0];
    const Vec3<T> normal = cross(e1, e2);
    const T twice_area = norm(normal);
    const Vec3<T> scaled = (share / larger(twice_area, T(1e-30f))) * normal;
    const Vec3<T> at_i = cross(e2, scaled), at_j = cross(scaled, e1);
    gradient[i] = gradient[i] + at_i;
    gradient[j] = gradient[j] + at_j;
    gradient[0] = gradient[0] - (at_i + at_j);
    area = area + share * twice_area;
  }
  return area;
}

/// Row r with r . x = 1/2 sum_i (cot a_i + cot b_i) (x_i - x_0), the Laplacian of position times the vertex's area on
/// a shape x (Meyer, Desbrun, Schroeder & Barr 2003, eq. 8); its length is 2 H A.
template <class R>
NPFEM_HD void ring_laplacian(const Vec3<R>* x, int count, R* row) {
  for (int i = 0; i < count; ++i) row[i] = R(0);
  for (int i = 1; i < count; ++i) {
    const int j = next_in_ring(i, count);
    const Vec3<R> at_i_0 = x[0] - x[i], at_i_j = x[j] - x[i], at_j_0 = x[0] - x[j];
    const R twice_area = larger(norm(cross(at_i_0, at_i_j)), R(1e-30f));
    row[j] += R(0.5) * dot(at_i_0, at_i_j) / twice_area;
    row[i] -= R(0.5) * dot(at_j_0, at_i_j) / twice_area;
  }
  for (int i = 1; i < count; ++i) row[0] -= row[i];
}

}  // namespace npfem
