// SPDX-License-Identifier: MPL-2.0
#include "contact/repulsion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/vec3.h"
#include "lattice/compensated_sum.h"
#include "lattice/lattice.h"

namespace npfem::flow {
namespace {

Vec3 vector_at(std::span<const double> xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

void require_sound(const RepulsionSettings& settings, double farthest, const char* between) {
  if (!(settings.range >= 0 && settings.strength >= 0 && std::isfinite(settings.strength))) {
    throw std::invalid_argument(std::string("repulsion ") + between + ": range " + std::to_string(settings.range) +
                                " um and strength " + std::to_string(settings.strength) +
                                " pN; neither may be negative or infinite");
  }
  if (settings.range > farthest) {
    throw std::invalid_argument(std::string("repulsion ") + between + ": range " + std::to_string(settings.range) +
                                " um; at most two node spacings (" + std::to_string(farthest) + " um) are allowed");
  }
}

}  // namespace

double repulsion_force(const RepulsionSettings& settings, double distance) {
  if (!(distance < settings.range)) return 0;
  const double depth = 1.0 - distance / settings.range;
  return settings.strength * depth * depth;
}

Vec3 pair_repulsion(const RepulsionSettings& settings, const Vec3& at, const Vec3& from, const Vec3& period) {
  Vec3 apart = subtract(at, from);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (period[axis] > 0) apart[axis] -= period[axis] * std::round(apart[axis] / period[axis]);
  }
  const double distance = norm(apart);
  if (!(distance > 0)) return {};
  return scale(repulsion_force(settings, distance) / distance, apart);
}

Repulsion::Repulsion(const Setup& setup, const Decomposition& decomposition, const Box& own)
    : setup_{setup.domain, {}, setup.cell_repulsion, setup.wall_repulsion},
      grid_(decomposition, own, setup.cell_repulsion.range / setup.domain.dx) {
  const double farthest = Lattice::kHalo * setup.domain.dx;
  require_sound(setup_.cells, farthest, "between cells");
  require_sound(setup_.walls, farthest, "from walls");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (setup.domain.periodic()[axis]) setup_.period[axis] = setup.domain.size()[axis];
  }
}

void Repulsion::evaluate(const KnownVertices& known, std::span<double> forces) {
  if (setup_.cells.range > 0) grid_.fill(known.in_nodes);
  std::array<CompensatedSum, 3> walls;
  for (std::size_t h = 0; h < known.held.size(); ++h) {
    const auto vertex = static_cast<std::size_t>(known.held[h]);
    const Vec3 cells = from_cells(known, vertex);
    const Vec3 wall = from_walls(vector_at(known.position, vertex));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      forces[3 * h + axis] = cells[axis] + wall[axis];
      walls[axis].add(wall[axis]);
    }
  }
  force_of_walls_ = {walls[0].value(), walls[1].value(), walls[2].value()};
}

Vec3 Repulsion::from_cells(const KnownVertices& known, std::size_t vertex) {
  if (!(setup_.cells.range > 0)) return {};
  hits_.clear();
  const Vec3 at = vector_at(known.position, vertex);
  const int cell = known.id[vertex].cell;
  grid_.visit_near(vertex, [&](std::size_t other) {
    if (known.id[other].cell == cell) return;
    const Vec3 force = pair_repulsion(setup_.cells, at, vector_at(known.position, other), setup_.period);
    if (force != Vec3{}) hits_.push_back({other, force});
  });
  // Known vertices are numbered in order of (cell, vertex).
  std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.partner < b.partner; });
  Vec3 sum{};
  for (const Hit& hit : hits_) sum = add(sum, hit.force);
  return sum;
}

Vec3 Repulsion::from_walls(const Vec3& position) const {
  if (!(setup_.walls.range > 0)) return {};
  const WallDistance wall = setup_.domain.wall_distance(position);
  return scale(repulsion_force(setup_.walls, wall.distance), wall.normal);
}

}  // namespace npfem::flow
