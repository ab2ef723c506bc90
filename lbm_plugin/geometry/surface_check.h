// SPDX-License-Identifier: MPL-2.0
// Is a surface of triangles the boundary of a solid?
#pragma once

#include <string>

#include "geometry/stl_file.h"

namespace npfem::flow {

/// The box that a surface is put into. Where the surface ends on a face that is `open`, the face closes it: there the
/// blood comes in, goes out or, across a periodic face, goes on.
struct SurroundingBox {
  Vec3 size;                 ///< um; from (0, 0, 0)
  std::array<bool, 6> open;  ///< x low, x high, y low, ...
  double tolerance;          ///< um: what is nearer to a face lies on it
};

/// Takes away the triangles that lie on an open face: the lids of a vessel drawn as a closed body.
void drop_lids(TriangleSurface& surface, const SurroundingBox& box);

/// Turns the triangles over, so that they run the other way round.
void turn_over(TriangleSurface& surface);

/// What is wrong with the surface and where, in one sentence without its subject: a hole, an edge that two triangles
/// run along the same way (one of them is inverted) or that more than two share, two triangles that cut each other, or
/// a vertex outside of the box. Empty where the surface, closed by the open faces, bounds a solid.
std::string fault_of(const TriangleSurface& surface, const SurroundingBox& box);

/// Volume inside the surface closed by the box, um3; negative where its triangles run clockwise seen from outside.
double volume_inside(const TriangleSurface& surface, const SurroundingBox& box);

}  // namespace npfem::flow
