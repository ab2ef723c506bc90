// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "communicator/communicator.h"

namespace npfem::flow {

/// A sum over all ranks that has the same bits for any number of them: terms are added as integers, in units of 2^-50.
/// For up to 2^32 terms below 2^10 in magnitude: lattice units.
class FixedPointSum {
 public:
  void add(double term) {
    if (!(std::abs(term) < largest)) {
      ++parts_[2];
      return;
    }
    const double whole = std::floor(term * coarse);
    parts_[0] += static_cast<std::int64_t>(whole);
    parts_[1] += static_cast<std::int64_t>((term * coarse - whole) * fine);
    // the remainder is below 2^-50 and is dropped
  }

  /// Collective; NaN where a term was not finite or too large.
  double total(Communicator& communicator) const {
    std::array<std::int64_t, 3> parts = parts_;
    communicator.sum(parts);
    if (parts[2] > 0) return std::numeric_limits<double>::quiet_NaN();
    return (static_cast<double>(parts[0]) + static_cast<double>(parts[1]) / fine) / coarse;
  }

 private:
  static constexpr double largest = 1 << 10;
  static constexpr double coarse = 1 << 20;
  static constexpr double fine = 1 << 30;
  std::array<std::int64_t, 3> parts_{};  // in units of 2^-20, of 2^-50, and the number of terms that do not fit
};

}  // namespace npfem::flow
