// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/carver.h"
#include "backend/cpu/kernel/rotation.h"
#include "backend/cpu/kernel/substitution.h"

namespace npfem::NPFEM_ISA {

/// Search directions of W cells at once, or of one: L-BFGS around a constant matrix (see reference/lbfgs.h). A pair
/// whose `rho` is zero in a lane does not exist for that lane, so lanes may forget on their own.
template <class Shape, class R, class H, int W>
class QuasiNewton {
 public:
  using P = Pack<R, W>;
  using Q = Pack<H, W>;
  using M = Mask<R, W>;

  QuasiNewton(const cpu::StepMatrices<H>& matrices, int num_vertices, int history, Carver& memory)
      : matrices_(matrices), n_(num_vertices), length_(Shape::length(num_vertices)), capacity_(history) {
    work_ = memory.take<Q>(length_);
    other_ = memory.take<Q>(length_);
    steps_ = memory.take<Q>(length_ * capacity_);
    changes_ = memory.take<Q>(length_ * capacity_);
    rho_ = memory.take<Q>(capacity_ + 1);
    alpha_ = memory.take<Q>(capacity_ + 1);
    forget(M::all());
  }

  void forget(M lanes) {
    const auto which = lanes_of_history(lanes);
    for (int j = 0; j < capacity_; ++j) rho_[j] = select(which, Q(H(0)), rho_[j]);
  }

  /// Lanes of `blocks` use the Hessian of the rest shape, turned by `rotation`; the others the scalar matrix.
  void choose(M blocks, const Matrix3<P>& rotation) {
    blocks_ = lanes_of_history(blocks);
    all_blocks_ = blocks.count() == W;
    any_blocks_ = blocks.any();
    for (int r = 0; r < 3; ++r) {
      rotation_.row[r] = {convert<H>(rotation.row[r].x), convert<H>(rotation.row[r].y), convert<H>(rotation.row[r].z)};
    }
  }

  /// From now on these lanes use the scalar matrix, with an empty memory.
  void fall_back(M lanes) {
    blocks_ = blocks_ & !lanes_of_history(lanes);
    all_blocks_ = blocks_.count() == W;
    any_blocks_ = blocks_.any();
    forget(lanes);
  }
  bool uses_blocks(int lane) const { return blocks_[lane]; }

  /// direction <- - H gradient.
  void direction(const P* gradient, P* direction) {
    for (int i = 0; i < length_; ++i) work_[i] = convert<H>(gradient[i]);
    for (int age = 0; age < kept_; ++age) {
      const int j = slot(age);
      const Q* const s = steps_ + length_ * j;
      const Q* const y = changes_ + length_ * j;
      const Q alpha = inner(s, work_) * rho_[j];
      alpha_[j] = alpha;
      for (int i = 0; i < length_; ++i) work_[i] -= alpha * y[i];
    }
    apply_inverse();
    for (int age = kept_; age-- > 0;) {
      const int j = slot(age);
      const Q* const s = steps_ + length_ * j;
      const Q rest = alpha_[j] - inner(changes_ + length_ * j, work_) * rho_[j];
      for (int i = 0; i < length_; ++i) work_[i] += rest * s[i];
    }
    for (int i = 0; i < length_; ++i) direction[i] = -convert<R>(work_[i]);
  }

  /// Remembers that the step from `here` to `there` changed the gradient; forgets the oldest pair. Only pairs of
  /// positive curvature (s . y > least |s||y|) are kept; least < 0 keeps all.
  void remember(const P* here, const P* there, const P* gradient_here, const P* gradient_there, R least) {
    if (capacity_ == 0) return;
    newest_ = (newest_ + 1) % capacity_;
    kept_ = kept_ < capacity_ ? kept_ + 1 : capacity_;
    Q* const s = steps_ + length_ * newest_;
    Q* const y = changes_ + length_ * newest_;
    P sy(R(0)), ss(R(0)), yy(R(0));
    for (int i = 0; i < length_; ++i) {
      const P ds = there[i] - here[i], dy = gradient_there[i] - gradient_here[i];
      sy += ds * dy, ss += ds * ds, yy += dy * dy;
      s[i] = convert<H>(ds);
      y[i] = convert<H>(dy);
    }
    sy = Shape::sum(sy);
    const P bound = P(least) * square_root(Shape::sum(ss)) * square_root(Shape::sum(yy));
    // Lanes that have stopped move no more: their pair is zero and teaches nothing.
    const M good = (sy > bound) & (P(R(0)) < magnitude(sy));
    rho_[newest_] = convert<H>(select(good, P(R(1)) / select(good, sy, P(R(1))), P(R(0))));
  }

 private:
  NPFEM_LANES_INLINE int slot(int age) const { return (newest_ - age + capacity_) % capacity_; }

  static auto lanes_of_history(M lanes) {
    if constexpr (sizeof(R) == sizeof(H)) {
      return lanes;
    } else {
      return Mask<H, W>{__builtin_convertvector(lanes.v, typename Mask<H, W>::Vector)};
    }
  }

  Q inner(const Q* a, const Q* b) const {
    // Four running sums: a chain of dependent additions would wait for each one.
    Q sum[4] = {Q(H(0)), Q(H(0)), Q(H(0)), Q(H(0))};
    int i = 0;
    for (; i + 4 <= length_; i += 4) {
      for (int k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
    }
    for (; i < length_; ++i) sum[0] += a[i] * b[i];
    return Shape::sum((sum[0] + sum[1]) + (sum[2] + sum[3]));
  }

  void apply_inverse() {
    if (!any_blocks_) return Shape::solve_scalar(matrices_.scalar, n_, work_);
    if (!all_blocks_) {
      for (int i = 0; i < length_; ++i) other_[i] = work_[i];
      Shape::solve_scalar(matrices_.scalar, n_, other_);
    }
    Shape::rotate_back(rotation_, n_, work_);
    solve_rest_hessian();
    Shape::rotate(rotation_, n_, work_);
    if (!all_blocks_) {
      for (int i = 0; i < length_; ++i) work_[i] = select(blocks_, work_[i], other_[i]);
    }
  }

  void solve_rest_hessian() {
    const cpu::GlobalCorrection<H>& global = matrices_.global;
    Q along[cpu::GlobalCorrection<H>::max_terms];
    for (int t = 0; t < global.num_terms; ++t) {
      Q sum(H(0));
      for (int i = 0; i < length_; ++i) sum += Shape::coefficient(global.direction[t], i) * work_[i];
      along[t] = Shape::sum(sum);
    }
    Shape::solve_blocks(matrices_.block, n_, work_);
    for (int t = 0; t < global.num_terms; ++t) {
      Q share(H(0));
      for (int u = 0; u < global.num_terms; ++u) share += Q(global.weight[t][u]) * along[u];
      for (int i = 0; i < length_; ++i) work_[i] -= share * Shape::coefficient(global.direction[t], i);
    }
  }

  const cpu::StepMatrices<H>& matrices_;
  int n_, length_, capacity_, kept_ = 0, newest_ = -1;
  Q *work_, *other_, *steps_, *changes_, *rho_, *alpha_;
  Mask<H, W> blocks_ = Mask<H, W>::none();
  bool all_blocks_ = false, any_blocks_ = false;
  Matrix3<Q> rotation_{};
};

}  // namespace npfem::NPFEM_ISA
