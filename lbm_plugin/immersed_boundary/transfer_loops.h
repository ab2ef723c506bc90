// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "immersed_boundary/stencil.h"
#include "immersed_boundary/transfer.h"
#include "lattice/kernel/isa.h"

namespace npfem::flow::NPFEM_ISA {

constexpr int halo = NodeMap::kHalo;
constexpr int lanes = NodeMap::kStrip;

NPFEM_INLINE int wrapped(const NodeTable& nodes, int axis, int i) {
  const int n = nodes.period[axis];
  if (n == 0 || (i >= 0 && i < n)) return i;
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

NPFEM_INLINE int clamped(int i, int low, int high) {
  return i < low ? low : (i > high ? high : i);
}

// The stored node at local indices, halo included; kNoNode where there is none.
NPFEM_INLINE NodeNumber node_number(const NodeTable& nodes, int ix, int iy, int iz) {
  const int x = ix + lanes;
  const std::int32_t strip = nodes.strips[(iz + halo) * nodes.plane + (iy + halo) * nodes.row + x / lanes];
  return strip < 0 ? NodeMap::kNoNode : strip * lanes + x % lanes;
}

// The first of `Points` stored nodes in a row, whose vectors then follow each other in memory; kNoNode where one is
// missing.
template <int Points>
NPFEM_INLINE NodeNumber nodes_in_row(const NodeTable& nodes, int ix, int iy, int iz) {
  const int x = ix + lanes;
  const std::int32_t* strip = nodes.strips + (iz + halo) * nodes.plane + (iy + halo) * nodes.row + x / lanes;
  const int lane = x % lanes;
  if (strip[0] < 0 || (lane + Points > lanes && strip[1] < 0)) return NodeMap::kNoNode;
  return strip[0] * lanes + lane;
}

// Four numbers in a row, wherever they begin.
template <class Real>
struct FourOf;
template <>
struct FourOf<double> {
  typedef double Type __attribute__((vector_size(32), aligned(8), may_alias));
};
template <>
struct FourOf<float> {
  typedef float Type __attribute__((vector_size(16), aligned(4), may_alias));
};

// `count` numbers, kept in registers.
template <class Real, int count>
struct Row {
  static constexpr int fours = count / 4;
  typename FourOf<Real>::Type four[fours + 1] = {};
  Real rest[count % 4 + 1] = {};

  NPFEM_INLINE void add(Real weight, const Real* row) {
#pragma GCC unroll 3
    for (int q = 0; q < fours; ++q) {
      four[q] += weight * *reinterpret_cast<const typename FourOf<Real>::Type*>(row + 4 * q);
    }
#pragma GCC unroll 3
    for (int q = 0; q < count % 4; ++q) rest[q] += weight * row[4 * fours + q];
  }
  NPFEM_INLINE void store(Real* row) const {
#pragma GCC unroll 3
    for (int q = 0; q < fours; ++q) *reinterpret_cast<typename FourOf<Real>::Type*>(row + 4 * q) = four[q];
#pragma GCC unroll 3
    for (int q = 0; q < count % 4; ++q) row[4 * fours + q] = rest[q];
  }
  NPFEM_INLINE void load(const Real* row) {
#pragma GCC unroll 3
    for (int q = 0; q < fours; ++q) four[q] = *reinterpret_cast<const typename FourOf<Real>::Type*>(row + 4 * q);
#pragma GCC unroll 3
    for (int q = 0; q < count % 4; ++q) rest[q] = row[4 * fours + q];
  }
};

// Weight of the row j, k of a stencil.
template <class Real, int Points>
NPFEM_INLINE Real row_weight(const Stencil<Points>& stencil, int j, int k) {
  return static_cast<Real>(stencil.weight[2][static_cast<std::size_t>(k)] *
                           stencil.weight[1][static_cast<std::size_t>(j)]);
}

// Sums of the vectors around a vertex over the rows, for each of the points along x; a node that is not stored counts
// as at rest. Beyond a wall there is nothing but wall: the outermost layer of the halo stands for it.
template <class Real, int Points>
[[gnu::noinline]] void sum_scattered(const NodeTable& nodes, const Real* vectors, const int (&index)[3][Points],
                                     const Real* weights, Real* sums) {
  for (int k = 0; k < Points; ++k) {
    for (int j = 0; j < Points; ++j) {
      for (int i = 0; i < Points; ++i) {
        const NodeNumber node = node_number(nodes, index[0][i], index[1][j], index[2][k]);
        if (node == NodeMap::kNoNode) continue;
        for (int axis = 0; axis < 3; ++axis) {
          sums[3 * i + axis] += weights[k * Points + j] * vectors[3 * std::ptrdiff_t{node} + axis];
        }
      }
    }
  }
}

template <class Real, int Points>
NPFEM_INLINE void interpolate_one(const NodeTable& nodes, const Real* vectors, const double* at, double* velocity) {
  const Vec3 position{at[0], at[1], at[2]};
  const Stencil<Points> stencil(position);
  const Index3 node = node_at(position);
  int index[3][Points];
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int first = stencil.first[a] + wrapped(nodes, axis, node[a]) - node[a] - nodes.begin[axis];
    for (int p = 0; p < Points; ++p) index[axis][p] = clamped(first + p, -halo, nodes.size[axis] + halo - 1);
  }
  Real weights[Points * Points];
  NodeNumber rows[Points * Points];
  bool whole = index[0][Points - 1] - index[0][0] == Points - 1;
  for (int k = 0; k < Points; ++k) {
    for (int j = 0; j < Points; ++j) {
      const int r = k * Points + j;
      weights[r] = row_weight<Real>(stencil, j, k);
      rows[r] = nodes_in_row<Points>(nodes, index[0][0], index[1][j], index[2][k]);
      whole = whole && rows[r] != NodeMap::kNoNode;
    }
  }
  Real sums[3 * Points] = {};
  if (whole) {
    Row<Real, 3 * Points> sum;
#pragma GCC unroll 4
    for (int r = 0; r < Points * Points; ++r) sum.add(weights[r], vectors + 3 * std::ptrdiff_t{rows[r]});
    sum.store(sums);
  } else {
    sum_scattered<Real, Points>(nodes, vectors, index, weights, sums);
  }
  for (int axis = 0; axis < 3; ++axis) {
    Real sum = 0;
    for (int i = 0; i < Points; ++i) {
      sum += static_cast<Real>(stencil.weight[0][static_cast<std::size_t>(i)]) * sums[3 * i + axis];
    }
    velocity[axis] = static_cast<double>(sum);
  }
}

template <class Real, int Points>
void interpolate(const NodeTable& nodes, const Real* vectors, const double* positions, const int* which,
                 std::ptrdiff_t count, double* velocities) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    interpolate_one<Real, Points>(nodes, vectors, positions + 3 * std::ptrdiff_t{which[i]}, velocities + 3 * i);
  }
}

// Local indices of the nodes of a stencil along one axis, -1 where the node is not this rank's. False if none is.
template <int Points>
NPFEM_INLINE bool own_indices(const NodeTable& nodes, int axis, int first, int* index) {
  bool some = false;
  const int begin = wrapped(nodes, axis, first) - nodes.begin[axis];
  for (int p = 0; p < Points; ++p) {
    const int local = wrapped(nodes, axis, begin + p + nodes.begin[axis]) - nodes.begin[axis];
    const bool here = local >= 0 && local < nodes.size[axis];
    index[p] = here ? local : -1;
    some = some || here;
  }
  return some;
}

template <class Real, int Points>
NPFEM_INLINE void spread_one(const NodeTable& nodes, Real* vectors, const double* at, const double* force, int z_begin,
                             int z_end) {
  const Vec3 position{at[0], at[1], at[2]};
  const Stencil<Points> stencil(position);
  int index[3][Points];
  if (!own_indices<Points>(nodes, 2, stencil.first[2], index[2])) return;
  if (!own_indices<Points>(nodes, 1, stencil.first[1], index[1])) return;
  if (!own_indices<Points>(nodes, 0, stencil.first[0], index[0])) return;
  Real along_x[3 * Points];
  for (int i = 0; i < Points; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      along_x[3 * i + axis] =
          static_cast<Real>(stencil.weight[0][static_cast<std::size_t>(i)]) * static_cast<Real>(force[axis]);
    }
  }
  const bool in_row = index[0][0] >= 0 && index[0][Points - 1] - index[0][0] == Points - 1;
  for (int k = 0; k < Points; ++k) {
    if (index[2][k] < z_begin || index[2][k] >= z_end) continue;
    for (int j = 0; j < Points; ++j) {
      if (index[1][j] < 0) continue;
      const Real weight = row_weight<Real>(stencil, j, k);
      const NodeNumber first =
          in_row ? nodes_in_row<Points>(nodes, index[0][0], index[1][j], index[2][k]) : NodeMap::kNoNode;
      if (first != NodeMap::kNoNode) {
        Real* const row = vectors + 3 * std::ptrdiff_t{first};
        Row<Real, 3 * Points> sum;
        sum.load(row);
        sum.add(weight, along_x);
        sum.store(row);
        continue;
      }
      for (int i = 0; i < Points; ++i) {
        if (index[0][i] < 0) continue;
        const NodeNumber node = node_number(nodes, index[0][i], index[1][j], index[2][k]);
        if (node == NodeMap::kNoNode) continue;
        for (int axis = 0; axis < 3; ++axis) {
          vectors[3 * std::ptrdiff_t{node} + axis] += weight * along_x[3 * i + axis];
        }
      }
    }
  }
}

template <class Real, int Points>
void spread(const NodeTable& nodes, Real* vectors, const double* positions, const double* forces, std::ptrdiff_t count,
            int z_begin, int z_end) {
  for (std::ptrdiff_t v = 0; v < count; ++v) {
    spread_one<Real, Points>(nodes, vectors, positions + 3 * v, forces + 3 * v, z_begin, z_end);
  }
}

template <class Real>
constexpr Transfer<Real> transfers[3] = {{&interpolate<Real, 2>, &spread<Real, 2>},
                                         {&interpolate<Real, 3>, &spread<Real, 3>},
                                         {&interpolate<Real, 4>, &spread<Real, 4>}};

// By number of points, from 2 on.
const Transfer<double>* double_transfers() {
  return transfers<double>;
}
const Transfer<float>* float_transfers() {
  return transfers<float>;
}

}  // namespace npfem::flow::NPFEM_ISA
