// SPDX-License-Identifier: MPL-2.0
#include "output/wall_forces.h"

#include "output/fixed_point_sum.h"

namespace npfem::flow {

std::vector<Vec3> wall_forces(const Lattice& lattice, Communicator& communicator) {
  std::vector<std::array<FixedPointSum, 3>> sums(static_cast<std::size_t>(lattice.boundaries()));
  lattice.for_each_wall_link([&](int boundary, int direction, double returned, double wall_term) {
    const auto& c = d3q19::kVelocity[static_cast<std::size_t>(direction)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (c[axis] != 0) sums[static_cast<std::size_t>(boundary)][axis].add(-c[axis] * (2 * returned + wall_term));
    }
  });
  std::vector<Vec3> forces(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b) {
    for (std::size_t axis = 0; axis < 3; ++axis) forces[b][axis] = sums[b][axis].total(communicator);
  }
  return forces;
}

}  // namespace npfem::flow
