// SPDX-License-Identifier: MPL-2.0
// Solves with a factor N = L D L^T shared by all cells: every entry of L is read once for all lanes. Both ways gather:
// each vertex is written once, so no sum waits for a number that was just stored.
#pragma once

#include "backend/cpu/kernel/elastic_forces.h"
#include "backend/cpu/step_task.h"

namespace npfem::NPFEM_ISA {

/// Sum over one row of L or L^T of numbers times the vectors of `b`. Two running sums, so that a fused multiply-add
/// seldom waits for the one before it.
template <class H, class Q>
NPFEM_LANES_INLINE Vec3<Q> row_times(const int* column, const H* value, int count, const Q* b) {
  const Vec3<Q> zero{Q(H(0)), Q(H(0)), Q(H(0))};
  Vec3<Q> even = zero, odd = zero;
  int k = 0;
  for (; k + 2 <= count; k += 2) {
    even = even + Q(value[k]) * load(b, column[k]);
    odd = odd + Q(value[k + 1]) * load(b, column[k + 1]);
  }
  if (k < count) even = even + Q(value[k]) * load(b, column[k]);
  return even + odd;
}

/// The same for 3 x 3 blocks by rows: nine running sums.
template <class H, class Q>
NPFEM_LANES_INLINE Vec3<Q> block_row_times(const int* column, const H* value, int count, const Q* b) {
  const Vec3<Q> zero{Q(H(0)), Q(H(0)), Q(H(0))};
  Vec3<Q> by_x = zero, by_y = zero, by_z = zero;
  for (int k = 0; k < count; ++k) {
    const H* m = value + 9 * k;
    const Vec3<Q> v = load(b, column[k]);
    by_x = by_x + v.x * Vec3<Q>{Q(m[0]), Q(m[3]), Q(m[6])};
    by_y = by_y + v.y * Vec3<Q>{Q(m[1]), Q(m[4]), Q(m[7])};
    by_z = by_z + v.z * Vec3<Q>{Q(m[2]), Q(m[5]), Q(m[8])};
  }
  return by_x + by_y + by_z;
}

/// b <- N^-1 b with one number for each pair of vertices, the same for x, y and z.
template <class H, class Q>
void solve_scalar(const cpu::FactorView<H>& f, int num_vertices, Q* b) {
  for (int i = 0; i < num_vertices; ++i) {
    const int k = f.row_start[i];
    store(b, i, load(b, i) - row_times(f.column + k, f.value + k, f.row_start[i + 1] - k, b));
  }
  for (int i = num_vertices; i-- > 0;) {
    const int k = f.back_start[i];
    const Vec3<Q> rest = row_times(f.back_column + k, f.back_value + k, f.back_start[i + 1] - k, b);
    store(b, i, Q(f.inverse_diagonal[i]) * load(b, i) - rest);
  }
}

/// b <- N^-1 b with a 3 x 3 block for each pair of vertices.
template <class H, class Q>
void solve_blocks(const cpu::FactorView<H>& f, int num_vertices, Q* b) {
  for (int i = 0; i < num_vertices; ++i) {
    const int k = f.row_start[i];
    store(b, i, load(b, i) - block_row_times(f.column + k, f.value + 9 * k, f.row_start[i + 1] - k, b));
  }
  for (int i = num_vertices; i-- > 0;) {
    const int k = f.back_start[i];
    const Vec3<Q> rest = block_row_times(f.back_column + k, f.back_value + 9 * k, f.back_start[i + 1] - k, b);
    const H* d = f.inverse_diagonal + 9 * i;
    const Vec3<Q> v = load(b, i);
    const Vec3<Q> own{Q(d[0]) * v.x + Q(d[1]) * v.y + Q(d[2]) * v.z, Q(d[3]) * v.x + Q(d[4]) * v.y + Q(d[5]) * v.z,
                      Q(d[6]) * v.x + Q(d[7]) * v.y + Q(d[8]) * v.z};
    store(b, i, own - rest);
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
