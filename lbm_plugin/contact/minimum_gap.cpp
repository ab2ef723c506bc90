// SPDX-License-Identifier: MPL-2.0
#include "contact/minimum_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "contact/closed_surface.h"
#include "geometry/bounds.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A triangle and the ball around it, by which it is dismissed cheaply.
struct BoundedTriangle {
  std::array<Vec3, 3> corner;
  Vec3 centre;
  double radius;
};

Vec3 vertex(const CellSurface& cell, std::size_t v) {
  return {cell.positions[3 * v], cell.positions[3 * v + 1], cell.positions[3 * v + 2]};
}

Bounds bounds_of(const CellSurface& cell) {
  Bounds bounds;
  for (std::size_t v = 0; v < cell.positions.size() / 3; ++v) bounds.include(vertex(cell, v));
  return bounds;
}

double distance(const Bounds& a, const Bounds& b, const Vec3& shift_of_b) {
  Vec3 apart{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double above = b.low[axis] + shift_of_b[axis] - a.high[axis];
    const double below = a.low[axis] - b.high[axis] - shift_of_b[axis];
    apart[axis] = std::max({0.0, above, below});
  }
  return norm(apart);
}

std::vector<BoundedTriangle> triangles_of(const CellSurface& cell, const std::vector<std::int32_t>& ids) {
  std::vector<BoundedTriangle> triangles;
  triangles.reserve(ids.size() / 3);
  for (std::size_t t = 0; t < ids.size(); t += 3) {
    BoundedTriangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle.corner[i] = vertex(cell, static_cast<std::size_t>(ids[t + i]));
    const auto& [a, b, c] = triangle.corner;
    triangle.centre = scale(1.0 / 3.0, add(a, add(b, c)));
    for (const Vec3& corner : triangle.corner) {
      triangle.radius = std::max(triangle.radius, norm(subtract(corner, triangle.centre)));
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

bool contains(const Bounds& bounds, const Vec3& point, double margin) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (point[axis] < bounds.low[axis] - margin || point[axis] > bounds.high[axis] + margin) return false;
  }
  return true;
}

/// A cell's surface, ready to be asked how far a point is from it.
struct Target {
  const CellSurface& cell;
  const ClosedSurface& surface;
  const Bounds& bounds;
  std::span<const BoundedTriangle> triangles;
};

/// Whether the surface winds round the point, by the sum of the solid angles of its triangles (van Oosterom & Strackee,
/// IEEE Trans. Biomed. Eng. 30 (1983) 125): right also for a crumpled surface, on which the side of the nearest
/// triangle may mislead.
bool winds_round(const Vec3& point, std::span<const BoundedTriangle> triangles) {
  double angle = 0;
  for (const BoundedTriangle& triangle : triangles) {
    const Vec3 a = subtract(triangle.corner[0], point);
    const Vec3 b = subtract(triangle.corner[1], point);
    const Vec3 c = subtract(triangle.corner[2], point);
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
  }
  return angle > 2 * std::numbers::pi;
}

/// Signed distance from the point to the surface; `best` where it is not nearer than that.
double signed_distance(const Vec3& point, const Target& target, double best) {
  // A point within the bounds may be inside, and then its distance counts however far from the surface it is.
  double nearest = contains(target.bounds, point, 0) ? kInfinity : best;
  std::size_t its_triangle = target.triangles.size();
  std::array<double, 3> its_weight{};
  Vec3 its_apart{};
  for (std::size_t t = 0; t < target.triangles.size(); ++t) {
    const BoundedTriangle& triangle = target.triangles[t];
    const Vec3 to_centre = subtract(point, triangle.centre);
    const double reach = nearest + triangle.radius;
    if (dot(to_centre, to_centre) >= reach * reach) continue;
    const std::array<double, 3> weight = nearest_on_triangle(point, triangle.corner);
    const Vec3 apart = subtract(point, weighted(weight, triangle.corner));
    if (norm(apart) >= nearest) continue;
    nearest = norm(apart);
    its_triangle = t;
    its_weight = weight;
    its_apart = apart;
  }
  if (its_triangle == target.triangles.size()) return best;
  const Vec3 outward = target.surface.outward(its_triangle, its_weight,
                                              [&](auto v) { return vertex(target.cell, static_cast<std::size_t>(v)); });
  const bool behind = dot(its_apart, outward) < 0;
  const bool inside = behind && contains(target.bounds, point, 0) && winds_round(point, target.triangles);
  return inside ? -nearest : std::min(nearest, best);
}

/// From the vertices of `cell`, moved by -shift, to the surface; `best` where none is nearer.
double nearest(const CellSurface& cell, const Vec3& shift, const Target& target, double best) {
  for (std::size_t v = 0; v < cell.positions.size() / 3; ++v) {
    const Vec3 point = subtract(vertex(cell, v), shift);
    if (!contains(target.bounds, point, std::max(best, 0.0))) continue;
    best = std::min(best, signed_distance(point, target, best));
  }
  return best;
}

/// Shifts by whole periods that bring `b` among the nearest images of `a`: those beside the nearest one, too.
std::vector<Vec3> images(const Domain& domain, const Bounds& a, const Bounds& b) {
  std::vector<Vec3> shifts{{0, 0, 0}};
  const Vec3 size = domain.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!domain.periodic()[axis]) continue;
    const double apart = 0.5 * (a.low[axis] + a.high[axis] - b.low[axis] - b.high[axis]);
    const double nearest_image = size[axis] * std::round(apart / size[axis]);
    std::vector<Vec3> more;
    for (Vec3 shift : shifts) {
      for (const double step : {0.0, -size[axis], size[axis]}) {
        shift[axis] = nearest_image + step;
        more.push_back(shift);
      }
    }
    shifts = std::move(more);
  }
  return shifts;
}

struct Candidate {
  double least;  // um: the gap cannot be smaller
  std::size_t a, b;
  Vec3 shift;  // of b
};

/// Pairs of one own cell and one other, or its own image, the most promising first.
std::vector<Candidate> candidates(const Domain& domain, std::span<const CellSurface> own,
                                  std::span<const CellSurface> all, std::span<const Bounds> bounds) {
  std::vector<Candidate> pairs;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Bounds mine = bounds_of(own[i]);
    for (std::size_t j = 0; j < all.size(); ++j) {
      for (const Vec3& shift : images(domain, mine, bounds[j])) {
        if (all[j].id == own[i].id && shift == Vec3{}) continue;
        pairs.push_back({distance(mine, bounds[j], shift), i, j, shift});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Candidate& a, const Candidate& b) { return a.least < b.least; });
  return pairs;
}

double smallest(Communicator& communicator, double value) {
  communicator.minimum(std::span(&value, 1));
  return value;
}

}  // namespace

std::vector<CellSurface> all_cells(std::span<const CellType> types, Communicator& communicator,
                                   std::span<const CellSurface> own) {
  Bytes packed;
  for (const CellSurface& cell : own) {
    const std::array<int, 2> tag{cell.id, cell.type};
    append<int>(packed, tag);
    append<double>(packed, cell.positions);
  }
  std::vector<CellSurface> all;
  for (const Bytes& bytes : communicator.all_gather(packed)) {
    for (std::size_t at = 0; at < bytes.size();) {
      std::array<int, 2> tag;
      std::memcpy(tag.data(), bytes.data() + at, sizeof tag);
      at += sizeof tag;
      CellSurface& cell = all.emplace_back(CellSurface{tag[0], tag[1], {}});
      cell.positions.resize(types[static_cast<std::size_t>(cell.type)].shape.size());
      const std::size_t length = cell.positions.size() * sizeof(double);
      std::memcpy(cell.positions.data(), bytes.data() + at, length);
      at += length;
    }
  }
  return all;
}

double smallest_cell_gap(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                         std::span<const CellSurface> own) {
  const std::vector<CellSurface> all = all_cells(types, communicator, own);
  std::vector<ClosedSurface> surfaces;
  for (const CellType& type : types) surfaces.emplace_back(type.shape, type.triangles);
  std::vector<Bounds> bounds(all.size());
  std::transform(all.begin(), all.end(), bounds.begin(), bounds_of);
  std::vector<std::vector<BoundedTriangle>> triangles(all.size());
  double best = kInfinity;
  for (const Candidate& pair : candidates(domain, own, all, bounds)) {
    // Cells whose bounds overlap may be inside each other, and so below any gap.
    if (pair.least > 0 && pair.least >= best) break;
    const CellSurface& other = all[pair.b];
    const auto type = static_cast<std::size_t>(other.type);
    if (triangles[pair.b].empty()) triangles[pair.b] = triangles_of(other, types[type].triangles);
    best = nearest(own[pair.a], pair.shift, {other, surfaces[type], bounds[pair.b], triangles[pair.b]}, best);
  }
  return smallest(communicator, best);
}

double smallest_wall_gap(const Domain& domain, Communicator& communicator, std::span<const CellSurface> own) {
  double best = kInfinity;
  for (const CellSurface& cell : own) {
    for (std::size_t v = 0; v < cell.positions.size() / 3; ++v) {
      best = std::min(best, domain.wall_distance(vertex(cell, v)).distance);
    }
  }
  return smallest(communicator, best);
}

}  // namespace npfem::flow
