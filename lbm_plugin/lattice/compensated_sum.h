// SPDX-License-Identifier: MPL-2.0
#pragma once

// Neumaier's summation: the rounding of a sum of millions of terms stays that of a single addition.

#include <cmath>

namespace npfem::flow {

class CompensatedSum {
 public:
  void add(double term) {
    const double total = sum_ + term;
    rest_ += std::abs(sum_) >= std::abs(term) ? (sum_ - total) + term : (term - total) + sum_;
    sum_ = total;
  }
  double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0.0;
  double rest_ = 0.0;
};

}  // namespace npfem::flow
