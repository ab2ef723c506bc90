// SPDX-License-Identifier: MPL-2.0
#include "geometry/tweezers_load.h"

#include <array>
#include <cmath>

#include "geometry/bounds.h"

namespace npfem::flow {

std::vector<double> tweezers_load(std::span<const double> shape, double force, double contact_width) {
  Bounds box;
  for (std::size_t i = 0; i < shape.size(); i += 3) box.include(Vec3{shape[i], shape[i + 1], shape[i + 2]});
  const Vec3 middle = scale(0.5, add(box.low, box.high));
  // More than half-way out: the hollows of a red cell come near the line too, but no bead touches them.
  const double half_way = 0.25 * (box.high[0] - box.low[0]);
  std::array<std::vector<std::size_t>, 2> ends;
  for (std::size_t v = 0; v < shape.size() / 3; ++v) {
    const Vec3 at = subtract(vector_at(shape, v), middle);
    const bool in_disc = std::hypot(at[1], at[2]) <= 0.5 * contact_width * (1 + 1e-9);
    if (in_disc && std::abs(at[0]) > half_way) ends[at[0] > 0 ? 1 : 0].push_back(v);
  }
  if (ends[0].empty() || ends[1].empty()) return {};
  std::vector<double> load(shape.size(), 0.0);
  for (std::size_t end = 0; end < 2; ++end) {
    const double share = (end == 0 ? -force : force) / static_cast<double>(ends[end].size());
    for (const std::size_t v : ends[end]) load[3 * v] = share;
  }
  return load;
}

}  // namespace npfem::flow
