// SPDX-License-Identifier: MPL-2.0
// How Contacts finds, by its lists, the nearest points of surfaces to vertices, and what follows from them.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "contact/contacts.h"

namespace npfem::flow {
namespace {

constexpr double no_direction = 1e-9;  // um: nearer than this the line between two points says nothing
constexpr double rounding = 1 + 1e-9;  // allowed for where triangles are passed over

}  // namespace

void Contacts::search() {
  const auto count = static_cast<int>(parts_.size());
#pragma omp parallel for schedule(dynamic)
  for (int n = 0; n < count; ++n) {
    Part& part = parts_[static_cast<std::size_t>(n)];
    part.hits.clear();
    for (const Meeting& meeting : part.meetings) meet(meeting, part);
  }
  for (const Part& part : parts_) {
    if (part.has_unknown_corner) {
      throw std::logic_error("contacts: a triangle within reach of a vertex has a neighbour whose corners are unknown");
    }
  }
}

/// Finds and loads the vertices that are within reach.
void Contacts::meet(const Meeting& meeting, Part& part) const {
  const std::int32_t* const vertex = part.vertices.data() + meeting.first_vertex;
  part.nearest.assign(meeting.last_vertex - meeting.first_vertex, {-1, {}, {}, reach_ * reach_});
  for (std::size_t n = meeting.first_visit; n < meeting.last_visit; ++n) {
    const Visit& visit = part.visits[n];
    load(cells_[meeting.other], visit.block, part.patch);
    for (std::size_t v = visit.first; v < visit.last; ++v) {
      const auto visitor = static_cast<std::size_t>(part.visitors[v]);
      come_nearer(subtract(position(vertex[visitor]), meeting.shift), part.patch, part.nearest[visitor]);
    }
  }
  for (std::size_t n = 0; n < part.nearest.size(); ++n) {
    if (part.nearest[n].triangle >= 0) press(meeting, vertex[n], part.nearest[n], part);
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
    patch.triangle[n] = t;
    patch.x[n] = centre[0], patch.y[n] = centre[1], patch.z[n] = centre[2];
    patch.nx[n] = normal[0], patch.ny[n] = normal[1], patch.nz[n] = normal[2];
    // Without roots: (reach + radius)^2 <= 2 reach^2 + 2 radius^2.
    patch.ball[n] = rounding * 2 * (reach_ * reach_ + square);
    patch.plane[n] = rounding * reach_ * reach_ * dot(normal, normal);
  }
}

/// Looks for a nearer point among the triangles whose ball and plane are near enough. Of two equally near triangles the
/// lower number counts, in whatever order they come.
void Contacts::come_nearer(const Vec3& point, const Patch& patch, Nearest& nearest) const {
  std::array<double, Patch::size> excess;
  for (std::size_t n = 0; n < patch.count; ++n) {
    const double dx = point[0] - patch.x[n], dy = point[1] - patch.y[n], dz = point[2] - patch.z[n];
    const double along = dx * patch.nx[n] + dy * patch.ny[n] + dz * patch.nz[n];
    excess[n] = std::max(dx * dx + dy * dy + dz * dz - patch.ball[n], along * along - patch.plane[n]);
  }
  for (std::size_t n = 0; n < patch.count; ++n) {
    if (excess[n] > 0) continue;
    const std::array<double, 3> weight = nearest_on_triangle(point, patch.corner[n]);
    const Vec3 apart = subtract(point, weighted(weight, patch.corner[n]));
    const double square = dot(apart, apart);
    const std::int32_t triangle = patch.triangle[n];
    const bool is_nearer = square < nearest.square || (square == nearest.square && triangle < nearest.triangle);
    if (is_nearer) nearest = {triangle, weight, apart, square};
  }
}

/// On which side of the surface the vertex is, and the force that follows.
void Contacts::press(const Meeting& meeting, std::int32_t vertex, const Nearest& nearest, Part& part) const {
  const Cell &mine = cells_[meeting.mine], &other = cells_[meeting.other];
  const ClosedSurface& surface = surfaces_[other.type];
  const auto triangle = static_cast<std::size_t>(nearest.triangle);
  const Vec3 outward = surface.outward(triangle, nearest.weight, [&](auto v) -> Vec3 {
    const std::int32_t known = place(other, static_cast<std::int32_t>(v));
    if (known >= 0) return position(known);
    part.has_unknown_corner = true;
    return {};
  });
  const double side = dot(nearest.apart, outward) < 0 ? -1 : 1;
  const double apart = std::sqrt(nearest.square), distance = side * apart;
  const ContactLaw& its = law(mine.type, other.type);
  if (!(distance < its.reach())) return;
  const double length = norm(outward);
  Vec3 direction{};
  if (apart > no_direction) {
    direction = scale(side / apart, nearest.apart);
  } else if (length > 0) {
    direction = scale(1 / length, outward);
  }
  const auto in_type = static_cast<std::size_t>(vertices_->id[static_cast<std::size_t>(vertex)].vertex);
  const double half_area = 0.5 * surfaces_[mine.type].area(in_type);
  const auto& ids = surface.triangle(triangle);
  part.hits.push_back({vertex,
                       {place(other, ids[0]), place(other, ids[1]), place(other, ids[2])},
                       nearest.weight,
                       scale(half_area * its.traction(distance), direction),
                       2 * half_area * its.slope(distance),
                       distance});
}

}  // namespace npfem::flow
