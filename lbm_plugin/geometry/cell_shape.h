// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>

#include "geometry/vec3.h"

namespace npfem::flow {

/// The body inside a closed surface as its volume moments see it: the ellipsoid of equal volume-normalised second
/// moments.
struct CellShape {
  Vec3 centre;         ///< centroid of the volume, um
  Vec3 semi_axes;      ///< of that ellipsoid, longest first, um
  Vec3 normal;         ///< unit vector of the shortest axis (the axis of a disc), upper half space
  double inclination;  ///< of the long axis of its projection on the x-y plane, rad from x, in (-pi/2, pi/2]
  double deformation;  ///< Taylor's D = (long - short) / (long + short): 0 for a sphere
};

/// Volume inside a closed surface, um3.
double enclosed_volume(std::span<const double> xyz, std::span<const std::int32_t> triangles);

CellShape shape_of(std::span<const double> xyz, std::span<const std::int32_t> triangles);

}  // namespace npfem::flow
