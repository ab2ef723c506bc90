// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "geometry/vec3.h"

namespace npfem::flow {

/// Distance from p to the triangle abc: to its face, an edge or a corner, whichever is nearest.
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace npfem::flow
