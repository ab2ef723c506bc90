// SPDX-License-Identifier: MPL-2.0
#include "output/cell_free_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace npfem::flow {
namespace {

constexpr double patch_size = 2;  // um

/// Two coordinates along the walls, in periods, and which wall.
struct OnWall {
  double u, v;
  int wall;
};

/// The walls of a domain, unrolled.
struct Walls {
  int count = 0;
  double length_u = 0, length_v = 0;  // um
};

Walls walls_of(const Domain& domain) {
  if (!domain.is_plain_channel()) return {};
  const Vec3 size = domain.size();
  switch (domain.kind) {
    case DomainKind::shear_box:
    case DomainKind::plates:
      return {2, size[0], size[2]};
    case DomainKind::tube:
      return {1, 2 * std::numbers::pi * domain.tube_radius, size[2]};
    default:
      return {};
  }
}

OnWall nearest_wall(const Domain& domain, const Vec3& x) {
  const Vec3 size = domain.size();
  if (domain.kind == DomainKind::tube) {
    const double angle = std::atan2(x[1] - 0.5 * size[1], x[0] - 0.5 * size[0]);
    return {angle / (2 * std::numbers::pi), x[2] / size[2], 0};
  }
  return {x[0] / size[0], x[2] / size[2], x[1] < 0.5 * size[1] ? 0 : 1};
}

int patch_along(double periods, int patches) {
  const double wrapped = periods - std::floor(periods);
  return std::min(static_cast<int>(wrapped * patches), patches - 1);
}

}  // namespace

double cell_free_layer(const Domain& domain, std::span<const CellState> local_cells, Communicator& communicator) {
  const Walls walls = walls_of(domain);
  if (walls.count == 0) return std::numeric_limits<double>::quiet_NaN();
  const int nu = std::max(1, static_cast<int>(std::lround(walls.length_u / patch_size)));
  const int nv = std::max(1, static_cast<int>(std::lround(walls.length_v / patch_size)));
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> nearest(static_cast<std::size_t>(walls.count) * static_cast<std::size_t>(nu * nv), none);
  for (const CellState& cell : local_cells) {
    for (std::size_t v = 0; v + 2 < cell.position.size(); v += 3) {
      const Vec3 x{cell.position[v], cell.position[v + 1], cell.position[v + 2]};
      const OnWall at = nearest_wall(domain, x);
      const int patch = (at.wall * nv + patch_along(at.v, nv)) * nu + patch_along(at.u, nu);
      double& least = nearest[static_cast<std::size_t>(patch)];
      least = std::min(least, domain.wall_distance(x).distance);
    }
  }
  communicator.minimum(nearest);
  double sum = 0;
  int count = 0;
  for (const double distance : nearest) {
    if (distance == none) continue;
    sum += distance;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace npfem::flow
