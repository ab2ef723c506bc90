// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec3.h"

namespace npfem::flow {

/// The piece of a surface that belongs to a vertex.
struct VertexPatch {
  double area = 0;  ///< um2: a third of the triangles around it
  Vec3 normal{};    ///< unit vector to the outside: the mean of those triangles by area
};

/// Of a closed surface whose triangles are counterclockwise seen from outside; xyz in um.
inline std::vector<VertexPatch> vertex_patches(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  std::vector<VertexPatch> patches(xyz.size() / 3);
  const auto position = [&](std::size_t corner) {
    const auto v = 3 * static_cast<std::size_t>(triangles[corner]);
    return Vec3{xyz[v], xyz[v + 1], xyz[v + 2]};
  };
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Vec3 a = position(t);
    const Vec3 doubled = cross(subtract(position(t + 1), a), subtract(position(t + 2), a));
    for (std::size_t corner = t; corner < t + 3; ++corner) {
      VertexPatch& patch = patches[static_cast<std::size_t>(triangles[corner])];
      patch.area += norm(doubled) / 6;
      patch.normal = add(patch.normal, doubled);
    }
  }
  for (VertexPatch& patch : patches) {
    const double length = norm(patch.normal);
    if (length > 0) patch.normal = scale(1.0 / length, patch.normal);
  }
  return patches;
}

}  // namespace npfem::flow
