// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <deque>
#include <vector>

#include "backend/reference/step_factor.h"

namespace npfem {

/// Limited-memory BFGS around a constant matrix (Nocedal & Wright, algorithm 7.4; Liu, Bouaziz & Kavan 2017 for the
/// constant matrix of projective dynamics as its start).
class Lbfgs {
 public:
  explicit Lbfgs(int pairs) : capacity_(static_cast<std::size_t>(pairs)) {}

  void clear() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// Remembers that the step s changed the gradient by y.
  void push(const VertexField& s, const VertexField& y) {
    if (capacity_ == 0) return;
    pairs_.push_back({s, y, inner(s, y)});
    if (pairs_.size() > capacity_) pairs_.pop_front();
  }

  /// - H gradient.
  VertexField direction(const VertexField& gradient, const StepFactor& factor) const {
    VertexField q = gradient;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = inner(pairs_[i].s, q) / pairs_[i].curvature;
      q -= alpha[i] * pairs_[i].y;
    }
    VertexField r = factor.solve(q);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const double beta = inner(pairs_[i].y, r) / pairs_[i].curvature;
      r += (alpha[i] - beta) * pairs_[i].s;
    }
    return -r;
  }

 private:
  struct Pair {
    VertexField s, y;
    double curvature;  // s . y
  };
  std::size_t capacity_;
  std::deque<Pair> pairs_;
};

}  // namespace npfem
