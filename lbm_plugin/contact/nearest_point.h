// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>

#include "geometry/vec3.h"

namespace npfem::flow {

using Corners = std::array<Vec3, 3>;

/// The point of a triangle nearest to another point: the mean of the corners with these weights, which sum to 1. Two
/// weights vanish where it is a corner, one where it lies on an edge.
std::array<double, 3> nearest_on_triangle(const Vec3& point, const Corners& corner);

inline Vec3 weighted(const std::array<double, 3>& weight, const Corners& corner) {
  return add(scale(weight[0], corner[0]), add(scale(weight[1], corner[1]), scale(weight[2], corner[2])));
}

}  // namespace npfem::flow
