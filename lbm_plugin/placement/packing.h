// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/domain.h"
#include "geometry/vec3.h"
#include "placement/distance_table.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// A rigid cell while it is being placed: the shape of its type, shrunk by `size` (1: full size), turned and moved.
struct RigidCell {
  int type = 0;
  Vec3 centre{};
  Rotation rotation = identity_rotation;
  double size = 1;
  bool fixed = false;  ///< stays where the user put it
};

/// What a cell comes too near to.
struct Clash {
  enum class With { nothing, wall, own_image, cell };
  With with = With::nothing;
  int cell = -1;  ///< number of the other cell
  explicit operator bool() const { return with != With::nothing; }
};

/// Rigid cells in a domain, and the question whether one more place is free.
///
/// Two surfaces keep a gap when no vertex of one lies nearer than the gap to the surface of the other, or inside it,
/// and the reverse; every periodic image counts. While cells are small the gap shrinks with them.
class Packing {
 public:
  Packing(const Domain& domain, std::span<const CellType> types, double largest_gap);

  std::vector<RigidCell>& cells() { return cells_; }
  const std::vector<RigidCell>& cells() const { return cells_; }

  /// The first thing in the way of `cell` at the required gap (at most the largest gap), the cell number `itself` not
  /// counted (-1: none).
  Clash clash(const RigidCell& cell, int itself, double gap) const;

  double volume_of(int type) const { return shapes_[static_cast<std::size_t>(type)].volume; }
  double radius_of(int type) const { return shapes_[static_cast<std::size_t>(type)].radius; }

 private:
  struct Shape {
    std::span<const double> xyz;
    DistanceTable distance;
    double radius;  ///< of the sphere about the origin around all vertices, um
    double volume;  ///< um3
  };
  const Shape& shape(const RigidCell& cell) const { return shapes_[static_cast<std::size_t>(cell.type)]; }
  bool too_near_wall(const RigidCell& cell, double gap) const;
  bool images_clash(const RigidCell& a, const RigidCell& b, bool same_cell, double gap) const;
  bool too_near(const RigidCell& a, const RigidCell& b, double gap) const;
  bool vertex_too_near(const RigidCell& a, const RigidCell& b, double gap) const;

  Domain domain_;
  std::vector<Shape> shapes_;
  std::vector<RigidCell> cells_;
};

}  // namespace npfem::flow
