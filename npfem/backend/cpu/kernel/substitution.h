// SPDX-License-Identifier: MPL-2.0
// Solves with a factor N = L D L^T shared by all cells: every entry of L is read once for all lanes. Forward by rows of
// L, backward by columns of L^T, which are the same rows: one array serves both ways and stays in the cache.
#pragma once

#include "backend/cpu/kernel/elastic_forces.h"
#include "backend/cpu/step_task.h"

namespace npfem::NPFEM_ISA {

/// b <- N^-1 b with one number for each pair of vertices, the same for x, y and z.
template <class H, class Q>
void solve_scalar(const cpu::FactorView<H>& factor, int num_vertices, Q* b) {
  for (int i = 0; i < num_vertices; ++i) {
    Vec3<Q> sum = load(b, i);
    for (int k = factor.row_start[i]; k < factor.row_start[i + 1]; ++k)
      sum = sum - Q(factor.value[k]) * load(b, factor.column[k]);
    store(b, i, sum);
  }
  for (int i = 0; i < num_vertices; ++i) store(b, i, Q(factor.inverse_diagonal[i]) * load(b, i));
  for (int i = num_vertices; i-- > 0;) {
    const Vec3<Q> known = load(b, i);
    for (int k = factor.row_start[i]; k < factor.row_start[i + 1]; ++k)
      add(b, factor.column[k], Q(-factor.value[k]) * known);
  }
}

/// m v, for a 3 x 3 block by rows.
template <class H, class Q>
NPFEM_LANES_INLINE Vec3<Q> block_times(const H* m, const Vec3<Q>& v) {
  return {Q(m[0]) * v.x + Q(m[1]) * v.y + Q(m[2]) * v.z, Q(m[3]) * v.x + Q(m[4]) * v.y + Q(m[5]) * v.z,
          Q(m[6]) * v.x + Q(m[7]) * v.y + Q(m[8]) * v.z};
}

/// b <- N^-1 b with a 3 x 3 block for each pair of vertices.
template <class H, class Q>
void solve_blocks(const cpu::FactorView<H>& factor, int num_vertices, Q* b) {
  for (int i = 0; i < num_vertices; ++i) {
    // Nine running sums, so that no fused multiply-add waits for the one before it.
    const Vec3<Q> zero{Q(H(0)), Q(H(0)), Q(H(0))};
    Vec3<Q> by_x = zero, by_y = zero, by_z = zero;
    for (int k = factor.row_start[i]; k < factor.row_start[i + 1]; ++k) {
      const H* m = factor.value + 9 * k;
      const Vec3<Q> v = load(b, factor.column[k]);
      by_x = by_x + v.x * Vec3<Q>{Q(m[0]), Q(m[3]), Q(m[6])};
      by_y = by_y + v.y * Vec3<Q>{Q(m[1]), Q(m[4]), Q(m[7])};
      by_z = by_z + v.z * Vec3<Q>{Q(m[2]), Q(m[5]), Q(m[8])};
    }
    store(b, i, load(b, i) - (by_x + by_y + by_z));
  }
  for (int i = 0; i < num_vertices; ++i) store(b, i, block_times(factor.inverse_diagonal + 9 * i, load(b, i)));
  for (int i = num_vertices; i-- > 0;) {
    const Vec3<Q> known = load(b, i);
    for (int k = factor.row_start[i]; k < factor.row_start[i + 1]; ++k) {
      const H* m = factor.value + 9 * k;
      Q* at = b + 3 * factor.column[k];
      at[0] -= Q(m[0]) * known.x + Q(m[3]) * known.y + Q(m[6]) * known.z;
      at[1] -= Q(m[1]) * known.x + Q(m[4]) * known.y + Q(m[7]) * known.z;
      at[2] -= Q(m[2]) * known.x + Q(m[5]) * known.y + Q(m[8]) * known.z;
    }
  }
}

/// product <- W x, W the weights of the quasi-Newton matrix.
template <class P, class R>
void weigh(const cpu::LineageMatrices<R>& matrices, int num_vertices, const P* x, P* product) {
  for (int i = 0; i < num_vertices; ++i) {
    Vec3<P> sum{P(R(0)), P(R(0)), P(R(0))};
    for (int k = matrices.row_start[i]; k < matrices.row_start[i + 1]; ++k)
      sum = sum + P(matrices.weight[k]) * load(x, matrices.column[k]);
    store(product, i, sum);
  }
}

}  // namespace npfem::NPFEM_ISA
