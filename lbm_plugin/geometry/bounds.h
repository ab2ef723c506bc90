// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "geometry/vec3.h"

namespace npfem::flow {

/// A box along the axes; empty at first.
struct Bounds {
  Vec3 low{infinity, infinity, infinity};
  Vec3 high{-infinity, -infinity, -infinity};

  void include(const Vec3& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  void include(const Bounds& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
  /// Whether the two come within `reach` of each other along every axis.
  bool is_near(const Bounds& other, double reach) const {
    // Without branches, which could not be foreseen.
    bool near = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      near &= (low[axis] <= other.high[axis] + reach) & (other.low[axis] <= high[axis] + reach);
    }
    return near;
  }
  Bounds moved(const Vec3& by) const { return {add(low, by), add(high, by)}; }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

}  // namespace npfem::flow
