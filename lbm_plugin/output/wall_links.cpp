// SPDX-License-Identifier: MPL-2.0
#include "output/wall_links.h"

#include <optional>

#include "output/fixed_point_sum.h"

namespace npfem::flow {

WallLinks::WallLinks(const Lattice& lattice, const Geometry& geometry) : boundaries_(geometry.boundaries.size()) {
  const NodeMap& grid = lattice.nodes();
  for (int iz = 0; iz < grid.size(2); ++iz) {
    for (int iy = 0; iy < grid.size(1); ++iy) {
      for (int ix = 0; ix < grid.size(0); ++ix) {
        if (lattice.node_type(ix, iy, iz) != kFluid) continue;
        for (int i = 1; i < d3q19::kDirections; ++i) {
          const auto& c = d3q19::kVelocity[static_cast<std::size_t>(i)];
          const NodeType type = lattice.node_type(ix + c[0], iy + c[1], iz + c[2]);
          if (type == kFluid) continue;
          const auto boundary = static_cast<std::size_t>(type - 1);
          const Boundary& wall = geometry.boundaries[boundary];
          if (wall.kind != Boundary::Kind::velocity) continue;
          links_.push_back({{ix, iy, iz}, i, boundary, 6 * d3q19::weight(i) * d3q19::along(i, wall.velocity)});
        }
      }
    }
  }
}

std::vector<Vec3> WallLinks::forces(const Lattice& lattice, Communicator& communicator) const {
  std::vector<std::array<FixedPointSum, 3>> sums(boundaries_);
  Lattice::Populations populations{};
  const Index3* at = nullptr;
  for (const Link& link : links_) {
    if (at == nullptr || *at != link.node)
      populations = lattice.populations_at(link.node[0], link.node[1], link.node[2]);
    at = &link.node;
    const double returned = populations[static_cast<std::size_t>(d3q19::opposite(link.direction))];
    const auto& c = d3q19::kVelocity[static_cast<std::size_t>(link.direction)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (c[axis] != 0) sums[link.boundary][axis].add(-c[axis] * (2 * returned + link.wall_term));
    }
  }
  std::vector<Vec3> forces(boundaries_);
  for (std::size_t b = 0; b < boundaries_; ++b) {
    for (std::size_t axis = 0; axis < 3; ++axis) forces[b][axis] = sums[b][axis].total(communicator);
  }
  return forces;
}

}  // namespace npfem::flow
