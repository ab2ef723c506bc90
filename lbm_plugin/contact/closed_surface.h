// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/nearest_point.h"
#include "geometry/vec3.h"

namespace npfem::flow {

/// How the triangles of a closed surface hang together, and so which side of it is outside: what all cells of a type
/// share, wherever their vertices are.
class ClosedSurface {
 public:
  /// Triangles counterclockwise seen from outside; `shape`: xyz of the vertices at rest, um.
  ClosedSurface(std::span<const double> shape, std::span<const std::int32_t> triangles);

  std::size_t vertices() const { return area_.size(); }
  std::size_t triangles() const { return triangle_.size(); }
  const std::array<std::int32_t, 3>& triangle(std::size_t t) const { return triangle_[t]; }
  /// Area (um2) that belongs to a vertex at rest: a third of the triangles around it.
  double area(std::size_t vertex) const { return area_[vertex]; }
  double largest_area() const;

  static constexpr std::size_t per_block = 8;
  /// Vertices and triangles in small blocks of neighbours, which a box around each dismisses together.
  std::size_t vertex_blocks() const { return (vertex_order_.size() + per_block - 1) / per_block; }
  std::size_t triangle_blocks() const { return (triangle_order_.size() + per_block - 1) / per_block; }
  std::span<const std::int32_t> vertex_block(std::size_t b) const { return block(vertex_order_, b); }
  std::span<const std::int32_t> triangle_block(std::size_t b) const { return block(triangle_order_, b); }
  /// The vertices of the triangles of a block, each once.
  std::span<const std::int32_t> corners_of_block(std::size_t b) const {
    return std::span(block_corners_).subspan(first_corner_[b], first_corner_[b + 1] - first_corner_[b]);
  }

  /// The outward direction, of any length, at the point of triangle t with these weights: the normal of the face, on an
  /// edge the sum of the two unit normals, at a vertex the sum of all around it weighted by their angles. The side of
  /// it on which a point lies whose nearest point this is, is the side of the surface on which it lies (Baerentzen &
  /// Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243). `position(v)`: where vertex v is now.
  template <class Position>
  Vec3 outward(std::size_t t, const std::array<double, 3>& weight, Position&& position) const {
    const int zeros = (weight[0] == 0) + (weight[1] == 0) + (weight[2] == 0);
    if (zeros == 0) return unit_normal(t, position);
    if (zeros == 1) {
      const std::size_t opposite = weight[0] == 0 ? 0 : weight[1] == 0 ? 1 : 2;
      return add(unit_normal(t, position), unit_normal(across_[t][opposite], position));
    }
    const std::size_t corner = weight[0] != 0 ? 0 : weight[1] != 0 ? 1 : 2;
    const auto vertex = static_cast<std::size_t>(triangle_[t][corner]);
    Vec3 sum{};
    for (std::size_t n = first_around_[vertex]; n < first_around_[vertex + 1]; ++n) {
      const std::size_t other = around_[n];
      sum = add(sum, scale(angle_at(other, vertex, position), unit_normal(other, position)));
    }
    return sum;
  }

 private:
  template <class Position>
  Corners corners(std::size_t t, Position&& position) const {
    const auto& ids = triangle_[t];
    return {position(ids[0]), position(ids[1]), position(ids[2])};
  }
  template <class Position>
  Vec3 unit_normal(std::size_t t, Position&& position) const {
    return unit_normal(corners(t, position));
  }
  template <class Position>
  double angle_at(std::size_t t, std::size_t vertex, Position&& position) const {
    const auto& ids = triangle_[t];
    const std::size_t corner = static_cast<std::size_t>(ids[0]) == vertex   ? 0
                               : static_cast<std::size_t>(ids[1]) == vertex ? 1
                                                                            : 2;
    return angle(corners(t, position), corner);
  }
  static Vec3 unit_normal(const Corners& corner);
  static double angle(const Corners& corner, std::size_t at);

  void join_edges();
  void make_blocks(std::span<const double> shape);

  static std::span<const std::int32_t> block(const std::vector<std::int32_t>& order, std::size_t b) {
    return std::span(order).subspan(per_block * b, std::min(per_block, order.size() - per_block * b));
  }

  std::vector<std::array<std::int32_t, 3>> triangle_;
  std::vector<std::array<std::size_t, 3>> across_;  // the triangle beyond the edge opposite each corner
  std::vector<std::size_t> first_around_, around_;  // by vertex: the triangles around it
  std::vector<double> area_;
  std::vector<std::int32_t> vertex_order_, triangle_order_;  // along a space-filling curve
  std::vector<std::size_t> first_corner_;                    // by block of triangles, into block_corners_
  std::vector<std::int32_t> block_corners_;
};

}  // namespace npfem::flow
