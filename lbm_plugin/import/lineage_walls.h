// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <optional>
#include <string>

#include "geometry/stl_file.h"

namespace npfem::flow {

/// What a wall file of the lineage stands for. The lineage forces the fluid to rest at each of its vertices; here it
/// becomes walls of the domain or a solid.
struct LineageWall {
  enum class Kind { planes, tube, box, body };
  Kind kind;
  double low = 0, high = 0;  ///< planes: their y, um
  Vec3 middle{};             ///< of a tube (x and y) or a box, um
  double radius = 0;         ///< of a tube, um
  Vec3 size{};               ///< of a box, um
};

/// Two planes across y, a round tube along z, or a closed body: none where the surface is nothing of these.
std::optional<LineageWall> recognised(const TriangleSurface& surface);

}  // namespace npfem::flow
