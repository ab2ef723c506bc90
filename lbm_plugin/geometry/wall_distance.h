// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "geometry/vec3.h"

namespace npfem::flow {

/// Distance to the nearest wall (um, positive inside the fluid) and the unit normal pointing into the fluid.
///
/// Right near the wall; farther from it than a few node spacings it may be an underestimate, never an overestimate.
struct WallDistance {
  double distance;
  Vec3 normal;
};

inline WallDistance nearer(const WallDistance& a, const WallDistance& b) {
  return b.distance < a.distance ? b : a;
}

}  // namespace npfem::flow
