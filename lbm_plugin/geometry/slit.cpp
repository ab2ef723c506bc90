// SPDX-License-Identifier: MPL-2.0
#include "geometry/slit.h"

#include <limits>

namespace npfem::flow {

Slit::Slit(const Shape& shape, const Vec3& box) : centre_(shape.centre) {
  const auto along = static_cast<std::size_t>(shape.along);
  // a block on each side of the opening, reaching beyond the box
  const auto add_blocks = [&](std::size_t axis, double opening) {
    for (const double side : {-1.0, 1.0}) {
      BoxSolid block{shape.centre, box};
      block.half_size[along] = 0.5 * shape.length;
      block.half_size[axis] = 0.5 * box[axis];
      block.centre[axis] += side * 0.5 * (opening + box[axis]);
      blocks_.push_back(block);
    }
  };
  const auto across = static_cast<std::size_t>(shape.across);
  add_blocks(across, shape.width);
  if (shape.depth) add_blocks(3 - along - across, *shape.depth);
}

WallDistance Slit::distance(const Vec3& position) const {
  WallDistance nearest{std::numeric_limits<double>::infinity(), {}};
  for (const BoxSolid& block : blocks_) nearest = nearer(nearest, block.distance(position));
  return nearest;
}

}  // namespace npfem::flow
