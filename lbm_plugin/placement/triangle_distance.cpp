// SPDX-License-Identifier: MPL-2.0
#include "placement/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace npfem::flow {
namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = subtract(b, a);
  const double t = std::clamp(dot(subtract(p, a), ab) / dot(ab, ab), 0.0, 1.0);
  return norm(subtract(p, add(a, scale(t, ab))));
}

}  // namespace

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(subtract(b, a), subtract(c, a));
  const auto inner_side = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(normal, subtract(to, from)), subtract(p, from)) >= 0;
  };
  if (inner_side(a, b) && inner_side(b, c) && inner_side(c, a)) {
    return std::abs(dot(subtract(p, a), normal)) / norm(normal);
  }
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

}  // namespace npfem::flow
