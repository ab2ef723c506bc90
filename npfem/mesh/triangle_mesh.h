// SPDX-License-Identifier: MPL-2.0
// A triangulated surface as plain arrays.
#pragma once

#include <array>
#include <vector>

namespace npfem {

using Point = std::array<double, 3>;  ///< um
using Triangle = std::array<int, 3>;  ///< vertex numbers, counter-clockwise seen from outside

struct TriangleMesh {
  std::vector<Point> positions;  ///< um
  std::vector<Triangle> triangles;
};

}  // namespace npfem
