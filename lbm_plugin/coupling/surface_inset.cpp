// SPDX-License-Identifier: MPL-2.0
#include "coupling/surface_inset.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace npfem::flow {
namespace {

/// Where a vertex has lost more of its area than this, at the tip of a crease, markers follow the area vector itself:
/// offset and its rates stay bounded however small that becomes.
constexpr double most_swelling = 1.5;

struct Corners {
  std::size_t i, j, k;
};
Corners corners(const std::vector<std::int32_t>& triangles, std::size_t t) {
  return {static_cast<std::size_t>(triangles[t]), static_cast<std::size_t>(triangles[t + 1]),
          static_cast<std::size_t>(triangles[t + 2])};
}

/// Sums of e1 x e2 of the triangles around every vertex, um2: six times its share of the area, along the normal.
void sum_areas(const std::vector<std::int32_t>& triangles, const double* x, double* sums) {
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const auto [i, j, k] = corners(triangles, t);
    const Vec3 area = cross(subtract(vector_at(x, j), vector_at(x, i)), subtract(vector_at(x, k), vector_at(x, i)));
    for (const std::size_t v : {i, j, k}) add_vector(sums, v, area);
  }
}

}  // namespace

double kernel_excess(int kernel_points) {
  switch (kernel_points) {
    case 2:
      return 0.277;
    case 3:
      return 0.365;
    case 4:
      return 0.485;
    default:
      throw std::invalid_argument("surface inset: a kernel of " + std::to_string(kernel_points) + " points");
  }
}

SurfaceInset::SurfaceInset(const Setup& setup, double depth) : setup_(setup), depth_(depth) {
  for (const CellType& type : setup.types) {
    std::vector<double> sums(type.shape.size(), 0.0);
    sum_areas(type.triangles, type.shape.data(), sums.data());
    std::vector<double>& areas = rest_area_.emplace_back();
    for (std::size_t v = 0; v < sums.size() / 3; ++v) areas.push_back(norm(vector_at(sums.data(), v)));
  }
}

void SurfaceInset::list_bodies(std::span<const VertexId> vertices) {
  bodies_.clear();
  for_each_body(vertices, [&](int id, std::size_t first, std::size_t count) {
    const auto type = static_cast<std::size_t>(setup_.cells[static_cast<std::size_t>(id)].type);
    bodies_.push_back({first, count, type});
  });
}

template <class Visit>
void SurfaceInset::for_each(Visit&& visit) {
  const auto count = static_cast<std::ptrdiff_t>(bodies_.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t b = 0; b < count; ++b) visit(bodies_[static_cast<std::size_t>(b)]);
}

std::span<const double> SurfaceInset::place(std::span<const VertexId> vertices, std::span<const double> positions) {
  markers_.assign(positions.begin(), positions.end());
  if (depth_ == 0) return markers_;
  positions_ = markers_;
  normals_.assign(positions.size(), 0.0);
  per_square_.resize(vertices.size());
  for (std::vector<double>* scratch : {&term_, &next_, &along_}) scratch->resize(positions.size());
  list_bodies(vertices);
  for_each([this](const Body& body) { place(body); });
  return markers_;
}

void SurfaceInset::place(const Body& body) {
  double* const normal = &normals_[3 * body.first];
  sum_areas(triangles(body), &positions_[3 * body.first], normal);
  for (std::size_t v = 0; v < body.count; ++v) {
    const double area = norm(vector_at(normal, v)), rest = rest_area_[body.type][v];
    const bool creased = most_swelling * area < rest;
    const double per_square = creased ? most_swelling * most_swelling / rest : rest / (area * area);
    add_vector(&markers_[3 * body.first], v, scale(-depth_ * per_square, vector_at(normal, v)));
    set_vector(normal, v, creased ? Vec3{} : scale(1 / area, vector_at(normal, v)));
    per_square_[body.first + v] = per_square;
  }
}

/// dm of a vertex whose area vector (along n, of length S) changes: (S0/S^2)(1 - 2 n n) dS, a symmetric matrix. Creased
/// vertices have no n.
Vec3 SurfaceInset::rate_of_offset(std::size_t vertex, const Vec3& change_of_area) const {
  const Vec3 n = vector_at(normals_.data(), vertex);
  return scale(per_square_[vertex], subtract(change_of_area, scale(2 * dot(n, change_of_area), n)));
}

/// N v.
void SurfaceInset::turn_offsets(const Body& body, const double* velocity, double* rate) const {
  const double* const x = &positions_[3 * body.first];
  std::fill(rate, rate + 3 * body.count, 0.0);
  const std::vector<std::int32_t>& all = triangles(body);
  for (std::size_t t = 0; t + 2 < all.size(); t += 3) {
    const auto [i, j, k] = corners(all, t);
    const Vec3 e1 = subtract(vector_at(x, j), vector_at(x, i)), e2 = subtract(vector_at(x, k), vector_at(x, i));
    const Vec3 w1 = subtract(vector_at(velocity, j), vector_at(velocity, i)),
               w2 = subtract(vector_at(velocity, k), vector_at(velocity, i));
    const Vec3 change = add(cross(w1, e2), cross(e1, w2));
    for (const std::size_t v : {i, j, k}) add_vector(rate, v, change);
  }
  for (std::size_t v = 0; v < body.count; ++v) set_vector(rate, v, rate_of_offset(body.first + v, vector_at(rate, v)));
}

/// N^T m.
void SurfaceInset::turn_offsets_transposed(const Body& body, const double* moment, double* force) {
  const double* const x = &positions_[3 * body.first];
  double* const along = &along_[3 * body.first];
  for (std::size_t v = 0; v < body.count; ++v) {
    set_vector(along, v, rate_of_offset(body.first + v, vector_at(moment, v)));
  }
  std::fill(force, force + 3 * body.count, 0.0);
  const std::vector<std::int32_t>& all = triangles(body);
  for (std::size_t t = 0; t + 2 < all.size(); t += 3) {
    const auto [i, j, k] = corners(all, t);
    const Vec3 e1 = subtract(vector_at(x, j), vector_at(x, i)), e2 = subtract(vector_at(x, k), vector_at(x, i));
    const Vec3 m = add(vector_at(along, i), add(vector_at(along, j), vector_at(along, k)));
    const Vec3 on_j = cross(e2, m), on_k = cross(m, e1);
    add_vector(force, j, on_j);
    add_vector(force, k, on_k);
    add_vector(force, i, scale(-1, add(on_j, on_k)));
  }
}

/// (1 + d T + d^2 T^2 + d^3 T^3) values, T as `turn` applies it.
template <class Turn>
void SurfaceInset::sum_series(const Body& body, double* values, Turn&& turn) {
  double* const term = &term_[3 * body.first];
  double* const next = &next_[3 * body.first];
  std::copy_n(values, 3 * body.count, term);
  for (int order = 1; order <= 3; ++order) {
    turn(term, next);
    for (std::size_t i = 0; i < 3 * body.count; ++i) {
      term[i] = depth_ * next[i];
      values[i] += term[i];
    }
  }
}

void SurfaceInset::to_vertices(std::span<double> velocities) {
  if (depth_ == 0) return;
  for_each([&](const Body& body) {
    sum_series(body, &velocities[3 * body.first],
               [&](const double* from, double* to) { turn_offsets(body, from, to); });
  });
}

void SurfaceInset::to_markers(std::span<double> forces) {
  if (depth_ == 0) return;
  for_each([&](const Body& body) {
    sum_series(body, &forces[3 * body.first],
               [&](const double* from, double* to) { turn_offsets_transposed(body, from, to); });
  });
}

}  // namespace npfem::flow
