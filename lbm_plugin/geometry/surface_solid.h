// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geometry/stl_file.h"
#include "geometry/wall_distance.h"

namespace npfem::flow {

/// A wall given by a surface of triangles: a vessel with the fluid inside, or a body with the fluid outside.
///
/// The signed distance is tabulated once on the nodes of the lattice, exactly there and trilinear between them, so that
/// asking for it costs a look-up; beyond a band of three node spacings it reads as the width of the band.
class SurfaceSolid {
 public:
  /// The nodes of the lattice, and which directions are periodic: the surface then goes on there.
  struct Grid {
    std::array<int, 3> nodes;
    double dx;  ///< um
    std::array<bool, 3> periodic;
  };
  /// `surface` must bound a solid (surface_check.h), its triangles counter-clockwise seen from outside.
  SurfaceSolid(const TriangleSurface& surface, const Grid& grid, bool fluid_inside);

  /// Middle of the box: positions are asked for inside of it.
  const Vec3& centre() const { return centre_; }
  WallDistance distance(const Vec3& position) const;

 private:
  std::size_t index(int i, int j, int k) const {  // from -1 to the number of nodes
    return static_cast<std::size_t>(i + 1) +
           stride_[0] * (static_cast<std::size_t>(j + 1) + stride_[1] * static_cast<std::size_t>(k + 1));
  }
  struct NodeRange {
    std::array<int, 3> first, last;
  };
  NodeRange nodes_near(const std::array<Vec3, 3>& corners, const Vec3& shift) const;
  void measure(const TriangleSurface& surface);
  void fill_far_nodes();

  Grid grid_;
  Vec3 centre_;
  double band_;  // um
  std::array<std::size_t, 3> stride_;
  std::shared_ptr<const std::vector<float>> shared_;  // um, positive in the fluid; shared by copies
  std::vector<float> values_;                         // while it is being made
};

}  // namespace npfem::flow
