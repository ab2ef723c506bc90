// SPDX-License-Identifier: MPL-2.0
// How Contacts lists which vertices may touch which triangles.
#include <algorithm>
#include <cmath>

#include "contact/contacts.h"

namespace npfem::flow {
namespace {

constexpr int number_of_parts = 64;

}  // namespace

bool Contacts::lists_hold() const {
  if (vertices_->id != listed_.id || vertices_->held != listed_.held) return false;
  const double farthest = 0.25 * skin_ * skin_;
  const double* const now = vertices_->position.data();
  const double* const then = listed_.position.data();
  double most = 0;
  for (std::size_t i = 0; i < vertices_->position.size(); i += 3) {
    const double dx = now[i] - then[i], dy = now[i + 1] - then[i + 1], dz = now[i + 2] - then[i + 2];
    most = std::max(most, dx * dx + dy * dy + dz * dz);
  }
  return most < farthest;
}

void Contacts::make_lists() {
  list_cells();
  const auto count = static_cast<int>(cells_.size());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < count; ++c) measure(static_cast<std::size_t>(c));
  pairs_.clear();
  if (reach_ > 0) box_pairs_.find(cell_boxes_, reach_ + skin_, pairs_);
  parts_.resize(number_of_parts);
#pragma omp parallel for schedule(dynamic)
  for (int n = 0; n < number_of_parts; ++n) {
    Part& part = parts_[static_cast<std::size_t>(n)];
    part.meetings.clear();
    part.visits.clear();
    part.vertices.clear();
    part.visitors.clear();
    const std::size_t first = pairs_.size() * static_cast<std::size_t>(n) / number_of_parts;
    const std::size_t last = pairs_.size() * (static_cast<std::size_t>(n) + 1) / number_of_parts;
    for (std::size_t p = first; p < last; ++p) {
      const auto a = static_cast<std::size_t>(pairs_[p].first), b = static_cast<std::size_t>(pairs_[p].second);
      const auto& image = pairs_[p].image;
      const Vec3 shift{image[0] * period_[0], image[1] * period_[1], image[2] * period_[2]};
      list_meeting(a, b, shift, part);
      list_meeting(b, a, scale(-1, shift), part);
    }
  }
  listed_ = *vertices_;
}

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
  cell.near_wall = wall_reach_ > 0 && domain_.wall_distance(middle).distance < half + wall_reach_ + skin_;
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

/// The held vertices of `mine` that may touch the surface of `other`.
void Contacts::list_meeting(std::size_t mine, std::size_t other, const Vec3& shift, Part& part) const {
  Meeting meeting{mine, other, shift, part.vertices.size(), 0, part.visits.size(), 0};
  const Bounds near = take_blocks(meeting, part);
  if (part.blocks.empty()) return;
  const Bounds box = take_vertices(meeting, near, part);
  for (const std::size_t block : part.blocks) {
    if (triangle_boxes_[cells_[other].triangle_boxes + block].is_near(box, reach_ + skin_)) {
      list_visit(meeting, block, part);
    }
  }
  meeting.last_vertex = part.vertices.size();
  meeting.last_visit = part.visits.size();
  if (meeting.last_visit > meeting.first_visit) {
    part.meetings.push_back(meeting);
  } else {
    part.vertices.resize(meeting.first_vertex);
  }
}

/// The triangles near my cell; returns the box around them, where the other cell itself sees it.
Bounds Contacts::take_blocks(const Meeting& meeting, Part& part) const {
  const Bounds my_box = cell_boxes_[meeting.mine].moved(scale(-1, meeting.shift));
  const Cell& other = cells_[meeting.other];
  Bounds near;
  part.blocks.clear();
  for (std::size_t b = 0; b < surfaces_[other.type].triangle_blocks(); ++b) {
    const Bounds& box = triangle_boxes_[other.triangle_boxes + b];
    if (!box.is_near(my_box, reach_ + skin_)) continue;
    part.blocks.push_back(b);
    near.include(box);
  }
  return near;
}

/// My held vertices in and around that box; returns the box around them, as the other cell sees it.
Bounds Contacts::take_vertices(const Meeting& meeting, const Bounds& near, Part& part) const {
  const Cell& mine = cells_[meeting.mine];
  const Bounds there = near.moved(meeting.shift);
  Bounds all;
  part.groups.clear();
  part.points.clear();
  for (std::size_t b = 0; b < surfaces_[mine.type].vertex_blocks(); ++b) {
    if (!vertex_boxes_[mine.vertex_boxes + b].is_near(there, reach_ + skin_)) continue;
    Group group{part.points.size(), 0, {}};
    for (const std::int32_t v : surfaces_[mine.type].vertex_block(b)) {
      const std::int32_t vertex = place(mine, v);
      if (vertex < 0 || !is_held_[static_cast<std::size_t>(vertex)]) continue;
      const Vec3 point = subtract(position(vertex), meeting.shift);
      if (!near.is_near({point, point}, reach_ + skin_)) continue;
      group.box.include(point);
      part.points.push_back(point);
      part.vertices.push_back(vertex);
    }
    group.last = part.points.size();
    if (group.last == group.first) continue;
    part.groups.push_back(group);
    all.include(group.box);
  }
  return all;
}

/// Whether the box comes within reach of the slab.
bool Contacts::is_near(const Bounds& box, const Slab& slab) const {
  double low = 0, high = 0;  // of position . normal in the box
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = box.low[axis] * slab.normal[axis], b = box.high[axis] * slab.normal[axis];
    low += std::min(a, b);
    high += std::max(a, b);
  }
  return (low <= slab.high + reach_ + skin_) & (high >= slab.low - reach_ - skin_);
}

/// The vertices of the meeting that are near one block of triangles.
void Contacts::list_visit(const Meeting& meeting, std::size_t block, Part& part) const {
  const double reach = reach_ + skin_;
  const std::size_t number = cells_[meeting.other].triangle_boxes + block;
  const Bounds& box = triangle_boxes_[number];
  const Slab& slab = slabs_[number];
  Visit visit{block, part.visitors.size(), 0};
  for (const Group& group : part.groups) {
    if (!group.box.is_near(box, reach) || !is_near(group.box, slab)) continue;
    for (std::size_t n = group.first; n < group.last; ++n) {
      const Vec3& point = part.points[n];
      const double height = dot(point, slab.normal);
      const bool in_slab = (height >= slab.low - reach) & (height <= slab.high + reach);
      if (in_slab & box.is_near({point, point}, reach)) part.visitors.push_back(static_cast<std::int32_t>(n));
    }
  }
  visit.last = part.visitors.size();
  if (visit.last > visit.first) part.visits.push_back(visit);
}

}  // namespace npfem::flow
