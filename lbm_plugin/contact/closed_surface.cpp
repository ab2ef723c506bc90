// SPDX-License-Identifier: MPL-2.0
#include "contact/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "geometry/bounds.h"
#include "geometry/morton.h"

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
  make_blocks(shape);
}

void ClosedSurface::make_blocks(std::span<const double> shape) {
  const auto place = [&](std::int32_t v) {
    const double* const x = shape.data() + 3 * v;
    return Vec3{x[0], x[1], x[2]};
  };
  Bounds box;
  for (std::size_t v = 0; v < vertices(); ++v) box.include(place(static_cast<std::int32_t>(v)));
  const auto sorted = [&](std::size_t count, const auto& middle) {
    std::vector<std::pair<std::uint64_t, std::int32_t>> numbers;
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(count); ++n) {
      numbers.emplace_back(morton_number(middle(n), box), n);
    }
    std::sort(numbers.begin(), numbers.end());
    std::vector<std::int32_t> order;
    for (const auto& entry : numbers) order.push_back(entry.second);
    return order;
  };
  vertex_order_ = sorted(vertices(), place);
  triangle_order_ = sorted(triangles(), [&](std::int32_t t) {
    const auto& ids = triangle_[static_cast<std::size_t>(t)];
    return scale(1.0 / 3.0, add(place(ids[0]), add(place(ids[1]), place(ids[2]))));
  });
  for (std::size_t b = 0; b < triangle_blocks(); ++b) {
    first_corner_.push_back(block_corners_.size());
    std::vector<std::int32_t> corners;
    for (const std::int32_t t : triangle_block(b)) {
      const auto& ids = triangle_[static_cast<std::size_t>(t)];
      corners.insert(corners.end(), ids.begin(), ids.end());
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    block_corners_.insert(block_corners_.end(), corners.begin(), corners.end());
  }
  first_corner_.push_back(block_corners_.size());
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
