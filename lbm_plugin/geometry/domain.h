// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace npfem::flow {

using Vec3 = std::array<double, 3>;

/// The space the blood flows in: a box of lattice nodes, some of its directions periodic, bounded by walls.
///
/// Node (i, j, k) stands at ((i + 1/2) dx, (j + 1/2) dx, (k + 1/2) dx), so the box [0, size] is filled by whole cells
/// of the lattice and half-way bounce-back puts a flat wall exactly on the face of the box.
enum class DomainKind {
  periodic_box,  ///< no walls
  shear_box,     ///< x and z periodic; plates at y = 0 and y = size_y move along x with -/+ half the relative speed
  plates,        ///< x and z periodic; plates at rest at y = 0 and y = size_y
  tube,          ///< z periodic; round tube along z, axis in the middle of the box
};

/// Distance to the nearest wall (um, positive inside the fluid) and the unit normal pointing into the fluid.
struct WallDistance {
  double distance;
  Vec3 normal;
};

struct Domain {
  DomainKind kind = DomainKind::periodic_box;
  std::array<int, 3> nodes{};  ///< lattice nodes along x, y, z
  double dx = 0;               ///< um
  double tube_radius = 0;      ///< um, tube only
  double plate_speed = 0;      ///< um/us: speed of the upper plate relative to the lower one, shear box only

  Vec3 size() const { return {nodes[0] * dx, nodes[1] * dx, nodes[2] * dx}; }
  std::array<bool, 3> periodic() const;
  /// 0: fluid. 1: wall at rest. 2: lower plate. 3: upper plate. Indices one outside the box are asked for too.
  std::uint8_t node_kind(std::array<int, 3> node) const;
  /// Velocity (um/us) of the wall of that kind.
  Vec3 wall_velocity(std::uint8_t kind) const;
  WallDistance wall_distance(const Vec3& position) const;
  /// Volume open to the fluid between the true (not the voxel) walls, um3.
  double fluid_volume() const;
};

}  // namespace npfem::flow
