// SPDX-License-Identifier: MPL-2.0
// How Contacts finds which vertices are near which triangles.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "contact/contacts.h"

namespace npfem::flow {
namespace {

constexpr int parts = 32;              // of the grid, searched side by side by the threads
constexpr double no_direction = 1e-9;  // um: nearer than this the line between two points says nothing

}  // namespace

Vec3 Contacts::position(std::int32_t vertex) const {
  const double* const at = &vertices_->position[3 * static_cast<std::size_t>(vertex)];
  return {at[0], at[1], at[2]};
}

Corners Contacts::corners(std::int32_t triangle, const std::array<int, 3>& image) const {
  const auto& ids = corner_[static_cast<std::size_t>(triangle)];
  const Vec3 shift{image[0] * period_[0], image[1] * period_[1], image[2] * period_[2]};
  return {add(position(ids[0]), shift), add(position(ids[1]), shift), add(position(ids[2]), shift)};
}

/// Finds the triangles whose corners are all known; nothing to do where the vertices are those of the last time.
void Contacts::list_triangles() {
  const std::vector<VertexId>& id = vertices_->id;
  if (id == listed_) return;
  cells_.clear();
  place_.clear();
  corner_.clear();
  triangle_in_type_.clear();
  cell_of_.resize(id.size());
  for (std::size_t first = 0, last = 0; first < id.size(); first = last) {
    while (last < id.size() && id[last].cell == id[first].cell) ++last;
    Cell cell{};
    cell.type = type_of_[static_cast<std::size_t>(id[first].cell)];
    cell.first_vertex = first;
    cell.last_vertex = last;
    std::fill(cell_of_.begin() + static_cast<std::ptrdiff_t>(first),
              cell_of_.begin() + static_cast<std::ptrdiff_t>(last), static_cast<std::int32_t>(cells_.size()));
    list_triangles_of(cell);
    cells_.push_back(cell);
  }
  balls_.resize(corner_.size());
  meets_itself_.resize(cells_.size());
  listed_ = id;
}

void Contacts::list_triangles_of(Cell& cell) {
  const ClosedSurface& surface = surfaces_[cell.type];
  cell.first_place = place_.size();
  place_.resize(place_.size() + surface.vertices(), -1);
  std::int32_t* const place = place_.data() + cell.first_place;
  for (std::size_t v = cell.first_vertex; v < cell.last_vertex; ++v) {
    place[vertices_->id[v].vertex] = static_cast<std::int32_t>(v);
  }
  cell.first_triangle = corner_.size();
  for (std::size_t t = 0; t < surface.triangles(); ++t) {
    const auto& ids = surface.triangle(t);
    const std::array<std::int32_t, 3> known{place[ids[0]], place[ids[1]], place[ids[2]]};
    if (known[0] < 0 || known[1] < 0 || known[2] < 0) continue;
    corner_.push_back(known);
    triangle_in_type_.push_back(static_cast<std::int32_t>(t));
  }
  cell.last_triangle = corner_.size();
}

void Contacts::measure() {
  const auto count = static_cast<int>(cells_.size());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < count; ++c) measure(cells_[static_cast<std::size_t>(c)]);
  largest_ball_ = 0;
  for (const Cell& cell : cells_) largest_ball_ = std::max(largest_ball_, cell.largest_ball);
}

/// Balls around the triangles of a cell, and whether it could meet itself or a wall.
void Contacts::measure(Cell& cell) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto number = static_cast<std::size_t>(&cell - cells_.data());
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (std::size_t i = 3 * cell.first_vertex; i < 3 * cell.last_vertex; ++i) {
    low[i % 3] = std::min(low[i % 3], vertices_->position[i]);
    high[i % 3] = std::max(high[i % 3], vertices_->position[i]);
  }
  meets_itself_[number] = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (period_[axis] > 0 && high[axis] - low[axis] + reach_ >= period_[axis]) meets_itself_[number] = 1;
  }
  const Vec3 middle = scale(0.5, add(low, high));
  const double half = 0.5 * norm(subtract(high, low));
  cell.near_wall = wall_reach_ > 0 && domain_.wall_distance(middle).distance < half + wall_reach_;
  cell.largest_ball = 0;
  if (!(reach_ > 0)) return;
  double largest = 0;
  for (std::size_t t = cell.first_triangle; t < cell.last_triangle; ++t) {
    const auto& ids = corner_[t];
    const Vec3 a = position(ids[0]), b = position(ids[1]), c = position(ids[2]);
    const Vec3 centre = scale(1.0 / 3.0, add(a, add(b, c)));
    const Vec3 ca = subtract(a, centre), cb = subtract(b, centre), cc = subtract(c, centre);
    const double square = std::max({dot(ca, ca), dot(cb, cb), dot(cc, cc)});
    const Vec3 at = grid_.carry(centre).at;
    const float radius = static_cast<float>(std::sqrt(square)) + slack_;
    balls_[t] = {static_cast<float>(at[0]),         static_cast<float>(at[1]),   static_cast<float>(at[2]), radius,
                 static_cast<std::int32_t>(number), static_cast<std::int32_t>(t)};
    largest = std::max(largest, static_cast<double>(radius));
  }
  cell.largest_ball = largest;
}

/// Sorts triangles and held vertices into the grid.
void Contacts::sort_held() {
  grid_.fill(balls_, reach_ + largest_ball_ + static_cast<double>(slack_), meets_itself_);
  const std::vector<int>& held = vertices_->held;
  carried_.resize(held.size());
  held_.resize(held.size());
  held_cube_.resize(held.size());
  held_begin_.assign(grid_.cubes() + 1, 0);
  for (std::size_t h = 0; h < held.size(); ++h) {
    carried_[h] = grid_.carry(position(held[h]));
    const std::size_t cube = grid_.cube_of(carried_[h].at);
    held_cube_[h] = static_cast<std::int32_t>(cube);
    ++held_begin_[cube];
  }
  for (std::size_t cube = 1; cube < held_begin_.size(); ++cube) held_begin_[cube] += held_begin_[cube - 1];
  for (std::size_t h = held.size(); h-- > 0;) {
    held_[--held_begin_[static_cast<std::size_t>(held_cube_[h])]] = static_cast<std::int32_t>(h);
  }
}

void Contacts::search() {
  work_.resize(parts);
#pragma omp parallel for schedule(dynamic)
  for (int part = 0; part < parts; ++part) {
    Work& work = work_[static_cast<std::size_t>(part)];
    work.hits.clear();
    const std::size_t first = grid_.cubes() * static_cast<std::size_t>(part) / parts;
    const std::size_t last = grid_.cubes() * (static_cast<std::size_t>(part) + 1) / parts;
    for (std::size_t cube = first; cube < last; ++cube) search_cube(cube, work);
  }
  for (const Work& work : work_) {
    if (work.has_unknown_corner) {
      throw std::logic_error("contacts: a triangle within reach of a vertex has a neighbour whose corners are unknown");
    }
  }
}

void Contacts::search_cube(std::size_t cube, Work& work) const {
  if (held_begin_[cube] == held_begin_[cube + 1]) return;
  const std::int32_t alone = grid_.cell_around(cube);
  if (alone == TriangleGrid::nothing) return;
  for (std::size_t n = held_begin_[cube]; n < held_begin_[cube + 1]; ++n) {
    const auto held = static_cast<std::size_t>(held_[n]);
    if (cell_of_[static_cast<std::size_t>(vertices_->held[held])] != alone) search_vertex(held, cube, work);
  }
}

void Contacts::search_vertex(std::size_t held, std::size_t cube, Work& work) const {
  const std::int32_t vertex = vertices_->held[held];
  const std::int32_t own = cell_of_[static_cast<std::size_t>(vertex)];
  const bool meets_itself = meets_itself_[static_cast<std::size_t>(own)] != 0;
  const TriangleGrid::Carried& carried = carried_[held];
  const Vec3 point = position(vertex);
  const auto x = static_cast<float>(carried.at[0]), y = static_cast<float>(carried.at[1]),
             z = static_cast<float>(carried.at[2]);
  const auto reach = static_cast<float>(reach_) + slack_;
  const std::array<float, 3> period{static_cast<float>(period_[0]), static_cast<float>(period_[1]),
                                    static_cast<float>(period_[2])};
  work.nearest.clear();
  grid_.visit_around(cube, [&](const TriangleBall& ball, const std::array<int, 3>& shift) {
    if (ball.cell == own && !meets_itself) return;
    const float dx = ball.x + static_cast<float>(shift[0]) * period[0] - x;
    const float dy = ball.y + static_cast<float>(shift[1]) * period[1] - y;
    const float dz = ball.z + static_cast<float>(shift[2]) * period[2] - z;
    const float within = reach + ball.radius;
    if (dx * dx + dy * dy + dz * dz > within * within) return;
    const Corners here = corners(ball.triangle, {});
    const Vec3 centre = scale(1.0 / 3.0, add(here[0], add(here[1], here[2])));
    const std::array<int, 3> turns = grid_.carry(centre).turns;
    Nearest candidate{ball.cell, {}, ball.triangle, {}, {}, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      candidate.image[axis] = shift[axis] + carried.turns[axis] - turns[axis];
    }
    if (ball.cell == own && candidate.image == std::array<int, 3>{}) return;
    const Corners corner = corners(ball.triangle, candidate.image);
    candidate.weight = nearest_on_triangle(point, corner);
    candidate.apart = subtract(point, weighted(candidate.weight, corner));
    candidate.square = dot(candidate.apart, candidate.apart);
    if (candidate.square < reach_ * reach_) note(candidate, work.nearest);
  });
  for (const Nearest& nearest : work.nearest) meet(vertex, nearest, work);
}

/// Keeps the nearest point of each cell and image; of two equally near ones that of the lower triangle.
void Contacts::note(Nearest candidate, std::vector<Nearest>& nearest) const {
  const auto number = [this](const Nearest& n) { return triangle_in_type_[static_cast<std::size_t>(n.triangle)]; };
  for (Nearest& known : nearest) {
    if (known.cell != candidate.cell || known.image != candidate.image) continue;
    const bool is_nearer =
        candidate.square < known.square || (candidate.square == known.square && number(candidate) < number(known));
    if (is_nearer) known = candidate;
    return;
  }
  nearest.push_back(candidate);
}

/// On which side of the surface the vertex is, and the force that follows.
void Contacts::meet(std::int32_t vertex, const Nearest& nearest, Work& work) const {
  const Cell& mine = cells_[static_cast<std::size_t>(cell_of_[static_cast<std::size_t>(vertex)])];
  const Cell& other = cells_[static_cast<std::size_t>(nearest.cell)];
  const ClosedSurface& surface = surfaces_[other.type];
  const auto in_type = static_cast<std::size_t>(triangle_in_type_[static_cast<std::size_t>(nearest.triangle)]);
  const Vec3 outward = surface.outward(in_type, nearest.weight, [&](auto v) -> Vec3 {
    const std::int32_t known = place_[other.first_place + static_cast<std::size_t>(v)];
    if (known >= 0) return position(known);
    work.has_unknown_corner = true;
    return {};
  });
  const double side = dot(nearest.apart, outward) < 0 ? -1 : 1;
  const double apart = std::sqrt(nearest.square), distance = side * apart;
  const ContactLaw& its = law(mine.type, other.type);
  if (!(distance < its.reach())) return;
  const double length = norm(outward);
  const Vec3 direction = apart > no_direction ? scale(side / apart, nearest.apart)
                         : length > 0         ? scale(1 / length, outward)
                                              : Vec3{};
  const auto in_cell = static_cast<std::size_t>(vertices_->id[static_cast<std::size_t>(vertex)].vertex);
  const double half_area = 0.5 * surfaces_[mine.type].area(in_cell);
  work.hits.push_back({vertex, corner_[static_cast<std::size_t>(nearest.triangle)], nearest.weight,
                       scale(half_area * its.traction(distance), direction), 2 * half_area * its.slope(distance),
                       distance});
}

}  // namespace npfem::flow
