// SPDX-License-Identifier: MPL-2.0
#include "geometry/box_solid.h"

#include <algorithm>
#include <cmath>

namespace npfem::flow {

WallDistance BoxSolid::distance(const Vec3& position) const {
  const Vec3 from_centre = subtract(position, centre);
  Vec3 beyond{};  // how far outside the pair of faces of each axis; negative between them
  for (std::size_t a = 0; a < 3; ++a) beyond[a] = std::abs(from_centre[a]) - half_size[a];
  const auto outward = [&](std::size_t a) { return std::copysign(1.0, from_centre[a]); };
  const auto largest = static_cast<std::size_t>(std::max_element(beyond.begin(), beyond.end()) - beyond.begin());
  if (beyond[largest] <= 0) {  // inside: the nearest face
    Vec3 normal{};
    normal[largest] = outward(largest);
    return {beyond[largest], normal};
  }
  Vec3 to_surface{};  // from the nearest point of the box: on a face, an edge or a corner
  for (std::size_t a = 0; a < 3; ++a) to_surface[a] = std::max(0.0, beyond[a]) * outward(a);
  const double distance = norm(to_surface);
  return {distance, scale(1 / distance, to_surface)};
}

WallDistance SphereSolid::distance(const Vec3& position) const {
  const Vec3 from_centre = subtract(position, centre);
  const double r = norm(from_centre);
  // in the middle every direction leads out; one is taken
  if (r == 0) return {-radius, {1, 0, 0}};
  return {r - radius, scale(1 / r, from_centre)};
}

}  // namespace npfem::flow
