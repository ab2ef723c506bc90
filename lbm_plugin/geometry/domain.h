// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/box_solid.h"
#include "geometry/constriction.h"
#include "geometry/opening.h"
#include "geometry/slit.h"
#include "geometry/surface_solid.h"
#include "geometry/wall_distance.h"

namespace npfem::flow {

/// The space the blood flows in: a box of lattice nodes, some of its directions periodic, bounded by walls.
///
/// Node (i, j, k) stands at ((i + 1/2) dx, (j + 1/2) dx, (k + 1/2) dx), so the box [0, size] is filled by whole cells
/// of the lattice and half-way bounce-back puts a flat wall exactly on the face of the box. A face that is neither
/// periodic nor an opening is a wall. Further walls are solids in that space, each a signed distance; the nearest
/// counts.
enum class DomainKind {
  periodic_box,  ///< no walls
  shear_box,     ///< x and z periodic; plates at y = 0 and y = size_y move along x with -/+ half the relative speed
  plates,        ///< x and z periodic; plates at rest at y = 0 and y = size_y
  tube,          ///< z periodic; round tube along z, axis in the middle of the box
  vessel,        ///< periodic where `vessel_periodic` says; walls given by the solids
};

using Solid = std::variant<BoxSolid, SphereSolid, Slit, Constriction, SurfaceSolid>;

struct Domain {
  DomainKind kind = DomainKind::periodic_box;
  std::array<int, 3> nodes{};  ///< lattice nodes along x, y, z
  double dx = 0;               ///< um
  double tube_radius = 0;      ///< um, tube only
  double plate_speed = 0;      ///< um/us: speed of the upper plate relative to the lower one, shear box only
  int plate_axis = 0;          ///< direction in which the plates of a shear box move, or a flow between plates goes
  std::array<bool, 3> vessel_periodic{};
  std::vector<Opening> openings = {};
  std::vector<Solid> solids = {};
  double share_of_fluid = 1;  ///< that the solids leave of the space of that kind; see measured_share_of_fluid()

  Vec3 size() const { return {nodes[0] * dx, nodes[1] * dx, nodes[2] * dx}; }
  std::array<bool, 3> periodic() const;
  /// Axis of the flow: z in a tube, else `plate_axis`.
  std::size_t flow_axis() const { return kind == DomainKind::tube ? 2 : static_cast<std::size_t>(plate_axis); }
  bool has_walls() const;
  /// Plates or a tube and nothing else: a channel of the same section everywhere, whose flow is known.
  bool is_plain_channel() const;
  /// Numbers into `openings`, by Face; -1: none.
  std::array<int, 6> opening_of_face() const;

  /// 0: fluid. 1: wall at rest. 2: lower plate. 3: upper plate. 4 + n: beyond opening n. Indices one outside the box
  /// are asked for too.
  std::uint8_t node_kind(std::array<int, 3> node) const;
  /// Velocity (um/us) of the wall of that kind.
  Vec3 wall_velocity(std::uint8_t kind) const;
  WallDistance wall_distance(const Vec3& position) const;
  /// The same, where an opening counts as a wall that stands cells_keep_from_opening() before its face.
  WallDistance distance_for_cells(const Vec3& position) const;
  /// No cell starts nearer to an opening (um): half a node before it would leave.
  double cells_keep_from_opening() const { return 3 * dx; }
  /// A vertex nearer to an opening (um) would act on the nodes next to it through the widest kernel, which reaches less
  /// than two nodes far; those nodes are half a node from the face.
  double cells_leave_before_opening() const { return 2.5 * dx; }
  /// Volume open to the fluid between the true (not the voxel) walls, um3.
  double fluid_volume() const;
};

inline constexpr std::uint8_t first_opening_kind = 4;

/// The share of its space that the solids leave to the fluid, by summing over a fine grid; 1 without solids.
double measured_share_of_fluid(const Domain& domain);

/// Share of the mean velocity at each node of an opening, index u + n v where u and v are the two other axes in order
/// and n is the number of nodes along the first of them; 0 where the walls close it.
std::vector<double> inlet_profile(const Domain& domain, const Opening& opening);

}  // namespace npfem::flow
