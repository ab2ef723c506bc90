// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/box_solid.h"

namespace npfem::flow {

/// A wall across the flow with one rectangular opening in it, like the slit between two endothelial cells that red
/// cells pass in the spleen.
class Slit {
 public:
  struct Shape {
    int along;                    ///< axis of the flow
    int across;                   ///< axis of the width
    Vec3 centre;                  ///< of the opening, um
    double length;                ///< of the passage: the thickness of the wall, um
    double width;                 ///< um
    std::optional<double> depth;  ///< along the third axis, um; none: through the whole box
  };
  /// `box`: size of the domain, um.
  Slit(const Shape& shape, const Vec3& box);

  const Vec3& centre() const { return centre_; }
  WallDistance distance(const Vec3& position) const;

 private:
  Vec3 centre_;
  std::vector<BoxSolid> blocks_;  // what is left of the wall: two or four overlapping blocks
};

}  // namespace npfem::flow
