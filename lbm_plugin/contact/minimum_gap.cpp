// SPDX-License-Identifier: MPL-2.0
#include "contact/minimum_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/box_pairs.h"
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

std::vector<BoundedTriangle> triangles_of(const CellSurface& cell, std::span<const std::int32_t> ids) {
  std::vector<BoundedTriangle> triangles;
  triangles.reserve(ids.size() / 3);
  for (std::size_t t = 0; t < ids.size(); t += 3) {
    BoundedTriangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.corner[i] = vector_at(cell.positions, static_cast<std::size_t>(ids[t + i]));
    }
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
  const Vec3 outward = target.surface.outward(
      its_triangle, its_weight, [&](auto v) { return vector_at(target.cell.positions, static_cast<std::size_t>(v)); });
  const bool behind = dot(its_apart, outward) < 0;
  const bool inside = behind && contains(target.bounds, point, 0) && winds_round(point, target.triangles);
  return inside ? -nearest : std::min(nearest, best);
}

/// From the vertices of `cell`, moved by -shift, to the surface; `best` where none is nearer.
double nearest(const CellSurface& cell, const Vec3& shift, const Target& target, double best) {
  for (std::size_t v = 0; v < cell.positions.size() / 3; ++v) {
    const Vec3 point = subtract(vector_at(cell.positions, v), shift);
    if (!contains(target.bounds, point, std::max(best, 0.0))) continue;
    best = std::min(best, signed_distance(point, target, best));
  }
  return best;
}

/// The gap between the cells of one rank and those around it.
class GapSearch {
 public:
  GapSearch(const Domain& domain, std::span<const CellType> types, const Surroundings& around)
      : domain_(domain), all_(around.cells), is_own_(around.is_own), triangles_(all_.size()) {
    for (const CellType& type : types) {
      surfaces_.emplace_back(type.shape, type.triangles);
      ids_.push_back(type.triangles);
    }
    for (const CellSurface& cell : all_) boxes_.push_back(bounds_of(cell));
  }

  /// Among the pairs whose boxes come within reach of each other. Cells whose boxes overlap are always looked at: one
  /// may be inside the other, and so below any gap.
  double run(double reach) {
    std::vector<BoxPair> pairs;
    BoxPairs(domain_).find(boxes_, reach, pairs);
    double best = kInfinity;
    for (const BoxPair& pair : pairs) best = nearest_of(pair, best);
    return best;
  }

 private:
  double nearest_of(const BoxPair& pair, double best) {
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const Vec3 size = domain_.size();
    const Vec3 shift{pair.image[0] * size[0], pair.image[1] * size[1], pair.image[2] * size[2]};
    if (is_own_[a]) best = nearest(all_[a], shift, target(b), best);
    if (is_own_[b]) best = nearest(all_[b], scale(-1, shift), target(a), best);
    return best;
  }

  Target target(std::size_t cell) {
    const auto type = static_cast<std::size_t>(all_[cell].type);
    if (triangles_[cell].empty()) triangles_[cell] = triangles_of(all_[cell], ids_[type]);
    return {all_[cell], surfaces_[type], boxes_[cell], triangles_[cell]};
  }

  const Domain& domain_;
  const std::vector<CellSurface>& all_;
  const std::vector<bool>& is_own_;
  std::vector<ClosedSurface> surfaces_;                  // by type
  std::vector<std::span<const std::int32_t>> ids_;       // of its triangles' corners, by type
  std::vector<std::vector<BoundedTriangle>> triangles_;  // by cell
  std::vector<Bounds> boxes_;
};

double smallest(Communicator& communicator, double value) {
  communicator.minimum(std::span(&value, 1));
  return value;
}

}  // namespace

/// Farther and farther afield, until nothing that was not looked at can be nearer than what was found.
double smallest_cell_gap(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                         std::span<const CellSurface> own) {
  Bounds whole;  // as far as any cell reaches
  for (const CellSurface& cell : own) whole.include(bounds_of(cell));
  communicator.minimum(whole.low);
  communicator.maximum(whole.high);
  if (!(whole.low[0] <= whole.high[0])) return kInfinity;
  double largest = 0;
  for (const CellSurface& cell : own) {
    const Bounds box = bounds_of(cell);
    largest = std::max(largest, norm(subtract(box.high, box.low)));
  }
  communicator.maximum(std::span(&largest, 1));
  const double farthest = norm(add(subtract(whole.high, whole.low), domain.size()));
  for (double reach = 0.1 * largest;; reach *= 4) {
    const Surroundings around = surroundings(domain, types, communicator, own, reach);
    const double best = smallest(communicator, GapSearch(domain, types, around).run(reach));
    if (best <= reach || reach > farthest) return best;
  }
}

double smallest_wall_gap(const Domain& domain, Communicator& communicator, std::span<const CellSurface> own) {
  double best = kInfinity;
  for (const CellSurface& cell : own) {
    for (std::size_t v = 0; v < cell.positions.size() / 3; ++v) {
      best = std::min(best, domain.wall_distance(vector_at(cell.positions, v)).distance);
    }
  }
  return smallest(communicator, best);
}

}  // namespace npfem::flow
