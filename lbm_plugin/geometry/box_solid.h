// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "geometry/wall_distance.h"

namespace npfem::flow {

/// A solid box with its edges along the axes.
struct BoxSolid {
  Vec3 centre;     ///< um
  Vec3 half_size;  ///< um

  WallDistance distance(const Vec3& position) const;
};

/// A solid ball.
struct SphereSolid {
  Vec3 centre;    ///< um
  double radius;  ///< um

  WallDistance distance(const Vec3& position) const;
};

}  // namespace npfem::flow
