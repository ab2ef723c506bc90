// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/surface_check.h"

namespace npfem::flow {
namespace {

constexpr double relative_tolerance = 1e-4;  // STL holds single precision

struct Extent {
  Vec3 low, high;
};

Extent extent_of(const TriangleSurface& surface) {
  Extent e{surface.vertices.front(), surface.vertices.front()};
  for (const Vec3& p : surface.vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      e.low[a] = std::min(e.low[a], p[a]);
      e.high[a] = std::max(e.high[a], p[a]);
    }
  }
  return e;
}

bool is_closed(const TriangleSurface& surface) {
  constexpr double far = 1e9;
  TriangleSurface moved = surface;
  for (Vec3& p : moved.vertices) p = add(p, {far / 2, far / 2, far / 2});
  return fault_of(moved, {{far, far, far}, {}, 0}).empty();
}

std::optional<LineageWall> planes(const TriangleSurface& surface, const Extent& extent) {
  const double tolerance = relative_tolerance * (extent.high[1] - extent.low[1]);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto p = surface.corners(t);
    const auto all_at = [&](double y) {
      return std::all_of(p.begin(), p.end(), [&](const Vec3& v) { return std::abs(v[1] - y) <= tolerance; });
    };
    if (!all_at(extent.low[1]) && !all_at(extent.high[1])) return std::nullopt;
  }
  if (!(tolerance > 0)) return std::nullopt;
  return LineageWall{.kind = LineageWall::Kind::planes, .low = extent.low[1], .high = extent.high[1]};
}

std::optional<LineageWall> tube(const TriangleSurface& surface, const Extent& extent) {
  const Vec3 middle = scale(0.5, add(extent.low, extent.high));
  const double radius = 0.5 * (extent.high[0] - extent.low[0]);
  for (const Vec3& p : surface.vertices) {
    const double r = std::hypot(p[0] - middle[0], p[1] - middle[1]);
    if (std::abs(r - radius) > 1e-2 * radius) return std::nullopt;
  }
  return LineageWall{.kind = LineageWall::Kind::tube, .middle = middle, .radius = radius};
}

}  // namespace

std::optional<LineageWall> recognised(const TriangleSurface& surface) {
  const Extent extent = extent_of(surface);
  if (const auto wall = planes(surface, extent)) return wall;
  if (!is_closed(surface)) return tube(surface, extent);
  const Vec3 size = subtract(extent.high, extent.low);
  LineageWall body{.kind = LineageWall::Kind::body, .middle = scale(0.5, add(extent.low, extent.high)), .size = size};
  const double volume = size[0] * size[1] * size[2];
  const double inside = std::abs(volume_inside(surface, {size, {}, 0}));
  if (std::abs(inside - volume) <= relative_tolerance * volume) body.kind = LineageWall::Kind::box;
  return body;
}

}  // namespace npfem::flow
