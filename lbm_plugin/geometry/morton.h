// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "geometry/bounds.h"

namespace npfem::flow {

/// Place of a point along Morton's space-filling curve through the box, 21 bits per axis: points with neighbouring
/// numbers are near each other.
inline std::uint64_t morton_number(const Vec3& point, const Bounds& box) {
  std::uint64_t number = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = box.high[axis] - box.low[axis];
    const double share = length > 0 ? std::clamp((point[axis] - box.low[axis]) / length, 0.0, 1.0) : 0.0;
    auto bits = static_cast<std::uint64_t>(share * 2097151.0);
    // Two zeros after every bit.
    bits = (bits | bits << 32) & 0x1f00000000ffffULL;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
    bits = (bits | bits << 2) & 0x1249249249249249ULL;
    number |= bits << axis;
  }
  return number;
}

}  // namespace npfem::flow
