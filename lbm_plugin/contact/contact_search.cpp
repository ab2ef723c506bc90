// SPDX-License-Identifier: MPL-2.0
// How Contacts finds which vertices are near which surfaces: cells whose boxes come near each other, blocks of their
// vertices and triangles, and at last single ones.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "contact/contacts.h"

namespace npfem::flow {
namespace {

constexpr int parts = 64;              // of the pairs, searched side by side by the threads
constexpr double no_direction = 1e-9;  // um: nearer than this the line between two points says nothing

}  // namespace

void Contacts::list_cells() {
  const std::vector<VertexId>& id = vertices_->id;
  is_held_.assign(id.size(), 0);
  for (const int v : vertices_->held) is_held_[static_cast<std::size_t>(v)] = 1;
  cells_.clear();
  place_.clear();
  std::size_t vertex_boxes = 0, triangle_boxes = 0;
  for (std::size_t first = 0, last = 0; first < id.size(); first = last) {
    while (last < id.size() && id[last].cell == id[first].cell) ++last;
    const std::size_t type = type_of_[static_cast<std::size_t>(id[first].cell)];
    const ClosedSurface& surface = surfaces_[type];
    Cell cell{type, first, last, -1, vertex_boxes, triangle_boxes, false};
    if (last - first < surface.vertices()) {
      cell.first_place = static_cast<std::ptrdiff_t>(place_.size());
      place_.resize(place_.size() + surface.vertices(), -1);
      for (std::size_t v = first; v < last; ++v) {
        place_[static_cast<std::size_t>(cell.first_place + id[v].vertex)] = static_cast<std::int32_t>(v);
      }
    }
    cells_.push_back(cell);
    vertex_boxes += surface.vertex_blocks();
    triangle_boxes += surface.triangle_blocks();
  }
  cell_boxes_.resize(cells_.size());
  vertex_boxes_.resize(vertex_boxes);
  triangle_boxes_.resize(triangle_boxes);
  slabs_.resize(triangle_boxes);
}

void Contacts::measure() {
  const auto count = static_cast<int>(cells_.size());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < count; ++c) measure(static_cast<std::size_t>(c));
}

/// Boxes around a cell and its blocks, and whether it comes near a wall.
void Contacts::measure(std::size_t number) {
  Cell& cell = cells_[number];
  const ClosedSurface& surface = surfaces_[cell.type];
  const auto box_of = [&](std::span<const std::int32_t> block) {
    Bounds box;
    for (const std::int32_t v : block) {
      const std::int32_t known = place(cell, v);
      if (known >= 0) box.include(position(known));
    }
    return box;
  };
  Bounds whole;
  for (std::size_t b = 0; b < surface.vertex_blocks(); ++b) {
    whole.include(vertex_boxes_[cell.vertex_boxes + b] = box_of(surface.vertex_block(b)));
  }
  for (std::size_t b = 0; b < surface.triangle_blocks(); ++b) {
    triangle_boxes_[cell.triangle_boxes + b] = box_of(surface.corners_of_block(b));
    slabs_[cell.triangle_boxes + b] = slab_around(cell, b);
  }
  cell_boxes_[number] = whole;
  const double half = 0.5 * norm(subtract(whole.high, whole.low));
  const Vec3 middle = scale(0.5, add(whole.low, whole.high));
  cell.near_wall = wall_reach_ > 0 && domain_.wall_distance(middle).distance < half + wall_reach_;
}

/// Across the mean normal of the block.
Contacts::Slab Contacts::slab_around(const Cell& cell, std::size_t block) const {
  const ClosedSurface& surface = surfaces_[cell.type];
  Vec3 normal{};
  for (const std::int32_t t : surface.triangle_block(block)) {
    const auto& ids = surface.triangle(static_cast<std::size_t>(t));
    const std::array<std::int32_t, 3> known{place(cell, ids[0]), place(cell, ids[1]), place(cell, ids[2])};
    if (known[0] < 0 || known[1] < 0 || known[2] < 0) continue;
    const Vec3 a = position(known[0]);
    normal = add(normal, cross(subtract(position(known[1]), a), subtract(position(known[2]), a)));
  }
  const double length = norm(normal);
  Slab slab{length > 0 ? scale(1 / length, normal) : Vec3{1, 0, 0}, Bounds::infinity, -Bounds::infinity};
  for (const std::int32_t v : surface.corners_of_block(block)) {
    const std::int32_t known = place(cell, v);
    if (known < 0) continue;
    const double height = dot(position(known), slab.normal);
    slab.low = std::min(slab.low, height);
    slab.high = std::max(slab.high, height);
  }
  return slab;
}

void Contacts::search() {
  box_pairs_.find(cell_boxes_, reach_, pairs_);
  work_.resize(parts);
#pragma omp parallel for schedule(dynamic)
  for (int part = 0; part < parts; ++part) {
    Work& work = work_[static_cast<std::size_t>(part)];
    work.hits.clear();
    const std::size_t first = pairs_.size() * static_cast<std::size_t>(part) / parts;
    const std::size_t last = pairs_.size() * (static_cast<std::size_t>(part) + 1) / parts;
    for (std::size_t p = first; p < last; ++p) {
      const auto a = static_cast<std::size_t>(pairs_[p].first), b = static_cast<std::size_t>(pairs_[p].second);
      const auto& n = pairs_[p].image;
      const Vec3 shift{n[0] * period_[0], n[1] * period_[1], n[2] * period_[2]};
      meet({cells_[a], cells_[b], cell_boxes_[a], cell_boxes_[b], shift}, work);
      meet({cells_[b], cells_[a], cell_boxes_[b], cell_boxes_[a], scale(-1, shift)}, work);
    }
  }
  for (const Work& work : work_) {
    if (work.has_unknown_corner) {
      throw std::logic_error("contacts: a triangle within reach of a vertex has a neighbour whose corners are unknown");
    }
  }
}

/// Finds and loads the held vertices of `mine` that are near the surface of `other`.
void Contacts::meet(const Encounter& e, Work& work) const {
  const Bounds near = take_blocks(e, work);
  if (work.blocks.empty()) return;
  const Bounds mine = take_candidates(e, near, work);
  for (const std::size_t block : work.blocks) {
    if (triangle_boxes_[e.other.triangle_boxes + block].is_near(mine, reach_)) approach(e, block, work);
  }
  for (const Candidate& candidate : work.candidates) {
    if (candidate.nearest < 0) continue;
    press(e, candidate.vertex, work.nearest[static_cast<std::size_t>(candidate.nearest)], work);
  }
}

/// The triangles near my cell; returns the box around them, where the other cell itself sees it.
Bounds Contacts::take_blocks(const Encounter& e, Work& work) const {
  const Bounds my_box = e.my_box.moved(scale(-1, e.shift));
  Bounds near;
  work.blocks.clear();
  for (std::size_t b = 0; b < surfaces_[e.other.type].triangle_blocks(); ++b) {
    const Bounds& box = triangle_boxes_[e.other.triangle_boxes + b];
    if (!box.is_near(my_box, reach_)) continue;
    work.blocks.push_back(b);
    near.include(box);
  }
  return near;
}

/// My held vertices in and around that box; returns the box around them, as the other cell sees it.
Bounds Contacts::take_candidates(const Encounter& e, const Bounds& near, Work& work) const {
  const Vec3 back = scale(-1, e.shift);
  const Bounds there = near.moved(e.shift);
  Bounds mine;
  work.candidates.clear();
  work.groups.clear();
  work.nearest.clear();
  for (std::size_t b = 0; b < surfaces_[e.mine.type].vertex_blocks(); ++b) {
    if (!vertex_boxes_[e.mine.vertex_boxes + b].is_near(there, reach_)) continue;
    Group group{work.candidates.size(), 0, {}};
    for (const std::int32_t v : surfaces_[e.mine.type].vertex_block(b)) {
      const std::int32_t vertex = place(e.mine, v);
      if (vertex < 0 || !is_held_[static_cast<std::size_t>(vertex)]) continue;
      const Vec3 point = add(position(vertex), back);
      if (!near.is_near({point, point}, reach_)) continue;
      group.box.include(point);
      work.candidates.push_back({point, vertex, -1});
    }
    group.last = work.candidates.size();
    if (group.last == group.first) continue;
    work.groups.push_back(group);
    mine.include(group.box);
  }
  return mine;
}

/// Whether the box comes within reach of the slab.
bool Contacts::is_near(const Bounds& box, const Slab& slab) const {
  double low = 0, high = 0;  // of position . normal in the box
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = box.low[axis] * slab.normal[axis], b = box.high[axis] * slab.normal[axis];
    low += std::min(a, b);
    high += std::max(a, b);
  }
  return (low <= slab.high + reach_) & (high >= slab.low - reach_);
}

/// Compares the candidates with the triangles of one block.
void Contacts::approach(const Encounter& e, std::size_t block, Work& work) const {
  const Bounds& box = triangle_boxes_[e.other.triangle_boxes + block];
  const Slab& slab = slabs_[e.other.triangle_boxes + block];
  bool is_loaded = false;
  for (const Group& group : work.groups) {
    if (!group.box.is_near(box, reach_) || !is_near(group.box, slab)) continue;
    for (std::size_t c = group.first; c < group.last; ++c) {
      Candidate& candidate = work.candidates[c];
      const double height = dot(candidate.point, slab.normal);
      const bool in_slab = (height >= slab.low - reach_) & (height <= slab.high + reach_);
      if (!(in_slab & box.is_near({candidate.point, candidate.point}, reach_))) continue;
      if (!is_loaded) load(e.other, block, work.patch);
      is_loaded = true;
      come_nearer(candidate, work);
    }
  }
}

void Contacts::load(const Cell& cell, std::size_t block, Patch& patch) const {
  const ClosedSurface& surface = surfaces_[cell.type];
  patch.count = 0;
  for (const std::int32_t t : surface.triangle_block(block)) {
    const auto& ids = surface.triangle(static_cast<std::size_t>(t));
    const std::array<std::int32_t, 3> known{place(cell, ids[0]), place(cell, ids[1]), place(cell, ids[2])};
    if (known[0] < 0 || known[1] < 0 || known[2] < 0) continue;
    const std::size_t n = patch.count++;
    Corners& corner = patch.corner[n];
    for (std::size_t c = 0; c < 3; ++c) corner[c] = position(known[c]);
    const Vec3 centre = scale(1.0 / 3.0, add(corner[0], add(corner[1], corner[2])));
    double square = 0;
    for (const Vec3& at : corner) square = std::max(square, dot(subtract(at, centre), subtract(at, centre)));
    const Vec3 normal = cross(subtract(corner[1], corner[0]), subtract(corner[2], corner[0]));
    const double length = norm(normal);
    const Vec3 unit = length > 0 ? scale(1 / length, normal) : Vec3{};
    patch.triangle[n] = t;
    patch.x[n] = centre[0], patch.y[n] = centre[1], patch.z[n] = centre[2];
    patch.radius[n] = std::sqrt(square);
    patch.nx[n] = unit[0], patch.ny[n] = unit[1], patch.nz[n] = unit[2];
  }
}

/// Looks for a nearer point among the triangles whose ball and plane are near enough. Of two equally near triangles the
/// lower number counts, in whatever order they come.
void Contacts::come_nearer(Candidate& candidate, Work& work) const {
  constexpr double rounding = 1 + 1e-12;
  const Patch& patch = work.patch;
  std::array<double, Patch::size> excess;
  const double reach = reach_ * rounding;
  for (std::size_t n = 0; n < patch.count; ++n) {
    const double dx = candidate.point[0] - patch.x[n], dy = candidate.point[1] - patch.y[n],
                 dz = candidate.point[2] - patch.z[n];
    const double to_plane = dx * patch.nx[n] + dy * patch.ny[n] + dz * patch.nz[n];
    const double within = reach + patch.radius[n] * rounding;
    excess[n] = std::max(dx * dx + dy * dy + dz * dz - within * within, to_plane * to_plane - reach * reach);
  }
  for (std::size_t n = 0; n < patch.count; ++n) {
    if (excess[n] > 0) continue;
    Nearest found{patch.triangle[n], nearest_on_triangle(candidate.point, patch.corner[n]), {}, 0};
    found.apart = subtract(candidate.point, weighted(found.weight, patch.corner[n]));
    found.square = dot(found.apart, found.apart);
    if (candidate.nearest < 0) {
      if (!(found.square < reach_ * reach_)) continue;
      candidate.nearest = static_cast<std::int32_t>(work.nearest.size());
      work.nearest.push_back(found);
      continue;
    }
    Nearest& nearest = work.nearest[static_cast<std::size_t>(candidate.nearest)];
    const bool is_nearer =
        found.square < nearest.square || (found.square == nearest.square && found.triangle < nearest.triangle);
    if (is_nearer) nearest = found;
  }
}

/// On which side of the surface the vertex is, and the force that follows.
void Contacts::press(const Encounter& e, std::int32_t vertex, const Nearest& nearest, Work& work) const {
  const ClosedSurface& surface = surfaces_[e.other.type];
  const auto triangle = static_cast<std::size_t>(nearest.triangle);
  const Vec3 outward = surface.outward(triangle, nearest.weight, [&](auto v) -> Vec3 {
    const std::int32_t known = place(e.other, static_cast<std::int32_t>(v));
    if (known >= 0) return position(known);
    work.has_unknown_corner = true;
    return {};
  });
  const double side = dot(nearest.apart, outward) < 0 ? -1 : 1;
  const double apart = std::sqrt(nearest.square), distance = side * apart;
  const ContactLaw& its = law(e.mine.type, e.other.type);
  if (!(distance < its.reach())) return;
  const double length = norm(outward);
  Vec3 direction{};
  if (apart > no_direction) {
    direction = scale(side / apart, nearest.apart);
  } else if (length > 0) {
    direction = scale(1 / length, outward);
  }
  const auto in_type = static_cast<std::size_t>(vertices_->id[static_cast<std::size_t>(vertex)].vertex);
  const double half_area = 0.5 * surfaces_[e.mine.type].area(in_type);
  const auto& ids = surface.triangle(triangle);
  work.hits.push_back({vertex,
                       {place(e.other, ids[0]), place(e.other, ids[1]), place(e.other, ids[2])},
                       nearest.weight,
                       scale(half_area * its.traction(distance), direction),
                       2 * half_area * its.slope(distance),
                       distance});
}

}  // namespace npfem::flow
