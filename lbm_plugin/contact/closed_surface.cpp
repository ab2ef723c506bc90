// SPDX-License-Identifier: MPL-2.0
#include "contact/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace npfem::flow {

ClosedSurface::ClosedSurface(std::span<const double> shape, std::span<const std::int32_t> triangles)
    : first_around_(shape.size() / 3 + 1), area_(shape.size() / 3) {
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    triangle_.push_back({triangles[i], triangles[i + 1], triangles[i + 2]});
    Corners corner;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = 3 * static_cast<std::size_t>(triangles[i + c]);
      corner[c] = {shape[v], shape[v + 1], shape[v + 2]};
      ++first_around_[v / 3];
    }
    const double third = norm(cross(subtract(corner[1], corner[0]), subtract(corner[2], corner[0]))) / 6;
    for (const std::int32_t v : triangle_.back()) area_[static_cast<std::size_t>(v)] += third;
  }
  // Counting sort: first_around_ says where each vertex's triangles end; filled from the back, where they begin.
  for (std::size_t v = 1; v < first_around_.size(); ++v) first_around_[v] += first_around_[v - 1];
  around_.resize(triangles.size());
  for (std::size_t t = triangle_.size(); t-- > 0;) {
    for (const std::int32_t v : triangle_[t]) around_[--first_around_[static_cast<std::size_t>(v)]] = t;
  }
  join_edges();
}

void ClosedSurface::join_edges() {
  struct Side {
    std::int32_t low, high;
    std::size_t triangle, opposite;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangle_.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangle_[t][(c + 1) % 3], triangle_[t][(c + 2) % 3]);
      sides.push_back({low, high, t, c});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  across_.resize(triangle_.size());
  for (std::size_t s = 0; s < sides.size(); s += 2) {
    const bool paired = s + 1 < sides.size() && sides[s].low == sides[s + 1].low && sides[s].high == sides[s + 1].high;
    if (!paired) {
      throw std::invalid_argument("contacts need closed surfaces: the edge between vertices " +
                                  std::to_string(sides[s].low) + " and " + std::to_string(sides[s].high) +
                                  " does not join two triangles");
    }
    across_[sides[s].triangle][sides[s].opposite] = sides[s + 1].triangle;
    across_[sides[s + 1].triangle][sides[s + 1].opposite] = sides[s].triangle;
  }
}

double ClosedSurface::largest_area() const {
  return area_.empty() ? 0 : *std::max_element(area_.begin(), area_.end());
}

Vec3 ClosedSurface::unit_normal(const Corners& corner) {
  const Vec3 normal = cross(subtract(corner[1], corner[0]), subtract(corner[2], corner[0]));
  const double length = norm(normal);
  return length > 0 ? scale(1 / length, normal) : Vec3{};
}

double ClosedSurface::angle(const Corners& corner, std::size_t at) {
  const Vec3 a = subtract(corner[(at + 1) % 3], corner[at]);
  const Vec3 b = subtract(corner[(at + 2) % 3], corner[at]);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace npfem::flow
