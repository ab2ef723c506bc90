// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/rotation.h"
#include "backend/cpu/kernel/substitution.h"

namespace npfem::NPFEM_ISA {

/// W cells at once, one in every lane.
template <class R, class H, int W>
struct CellsInLanes {
  using P = Pack<R, W>;
  using Q = Pack<H, W>;
  static constexpr int cells = W, lanes = W;

  static int length(int num_vertices) { return 3 * num_vertices; }
  template <class T>
  NPFEM_LANES_INLINE static T sum(T a) {
    return a;
  }
  NPFEM_LANES_INLINE static P largest(P a) { return a; }
  NPFEM_LANES_INLINE static Q coefficient(const H* field, int i) { return Q(field[i]); }

  static P forces(const cpu::CellPlan<R>& plan, const P* x, P* gradient, P* area_gradient, P* volume_gradient,
                  P* energies) {
    return elastic_forces(plan, x, gradient, area_gradient, volume_gradient, energies);
  }
  static P viscous_forces(const cpu::CellPlan<R>& plan, const MembraneViscosity::Params<R>& per_time, R past,
                          const P* start, const P* last_move, const P* move, P* gradient) {
    return NPFEM_ISA::viscous_forces(plan, per_time, past, start, last_move, move, gradient);
  }
  template <class T>
  static void solve_scalar(const cpu::FactorView<T>& factor, int n, Pack<T, W>* b) {
    NPFEM_ISA::solve_scalar(factor, n, b);
  }
  static void solve_blocks(const cpu::FactorView<H>& factor, int n, Q* b) { NPFEM_ISA::solve_blocks(factor, n, b); }
  static void weigh(const cpu::LineageMatrices<R>& matrices, int n, const P* x, P* product) {
    NPFEM_ISA::weigh(matrices, n, x, product);
  }
  static void rotate(const Matrix3<Q>& rotation, int n, Q* field) {
    for (int i = 0; i < n; ++i) store(field, i, times(rotation, load(field, i)));
  }
  static void rotate_back(const Matrix3<Q>& rotation, int n, Q* field) {
    for (int i = 0; i < n; ++i) store(field, i, transposed_times(rotation, load(field, i)));
  }
};

}  // namespace npfem::NPFEM_ISA
