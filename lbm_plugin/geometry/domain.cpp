// SPDX-License-Identifier: MPL-2.0
#include "geometry/domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/section_flow.h"

namespace npfem::flow {
namespace {

constexpr std::uint8_t fluid = 0;
constexpr std::uint8_t wall_at_rest = 1;
constexpr std::uint8_t lower_plate = 2;
constexpr std::uint8_t upper_plate = 3;

bool between_plates(DomainKind kind) {
  return kind == DomainKind::shear_box || kind == DomainKind::plates;
}

Vec3 node_position(const Domain& domain, const std::array<int, 3>& node) {
  return scale(domain.dx, {node[0] + 0.5, node[1] + 0.5, node[2] + 0.5});
}

std::array<bool, 3> periodic_without_openings(const Domain& domain) {
  switch (domain.kind) {
    case DomainKind::periodic_box:
      return {true, true, true};
    case DomainKind::shear_box:
    case DomainKind::plates:
      return {true, false, true};
    case DomainKind::tube:
      return {false, false, true};
    case DomainKind::vessel:
      return domain.vessel_periodic;
  }
  return {};
}

WallDistance distance_to_tube(const Vec3& from_axis, double radius) {
  const double r = std::hypot(from_axis[0], from_axis[1]);
  // on the axis every direction leads to the wall; one is taken
  if (r == 0) return {radius, {1, 0, 0}};
  return {radius - r, {-from_axis[0] / r, -from_axis[1] / r, 0}};
}

/// To the faces of the box that are walls; those around a tube lie behind its wall.
WallDistance distance_to_faces(const Domain& domain, const Vec3& position) {
  const std::array<bool, 3> periodic = domain.periodic();
  const std::array<int, 6> opening = domain.opening_of_face();
  const Vec3 box = domain.size();
  WallDistance nearest{std::numeric_limits<double>::infinity(), {0, 0, 0}};
  for (int n = 0; n < 6; ++n) {
    const auto face = static_cast<Face>(n);
    const std::size_t axis = axis_of(face);
    const bool behind_tube = domain.kind == DomainKind::tube && axis < 2;
    if (periodic[axis] || opening[static_cast<std::size_t>(n)] >= 0 || behind_tube) continue;
    const double distance = is_high(face) ? box[axis] - position[axis] : position[axis];
    if (distance <= nearest.distance) nearest = {distance, inward(face)};
  }
  return nearest;
}

Vec3 centre_of(const Solid& solid) {
  return std::visit(
      [](const auto& its) -> Vec3 {
        if constexpr (requires { its.centre(); }) {
          return its.centre();
        } else {
          return its.centre;
        }
      },
      solid);
}

/// To the periodic image of the solid that is nearest: whose centre is.
WallDistance distance_to_solid(const Solid& solid, Vec3 position, const Domain& domain) {
  const std::array<bool, 3> periodic = domain.periodic();
  const Vec3 box = domain.size();
  const Vec3 centre = centre_of(solid);
  for (std::size_t a = 0; a < 3; ++a) {
    if (periodic[a]) position[a] -= box[a] * std::round((position[a] - centre[a]) / box[a]);
  }
  return std::visit([&](const auto& its) { return its.distance(position); }, solid);
}

/// In the space of the kind, before the solids.
bool in_open_space(const Domain& domain, const std::array<int, 3>& node) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (node[a] < 0 || node[a] >= domain.nodes[a]) return false;
  }
  if (domain.kind != DomainKind::tube) return true;
  const double x = (node[0] + 0.5 - 0.5 * domain.nodes[0]) * domain.dx;
  const double y = (node[1] + 0.5 - 0.5 * domain.nodes[1]) * domain.dx;
  return x * x + y * y < domain.tube_radius * domain.tube_radius;
}

bool is_fluid(const Domain& domain, const std::array<int, 3>& node) {
  return in_open_space(domain, node) &&
         std::all_of(domain.solids.begin(), domain.solids.end(), [&](const Solid& solid) {
           return distance_to_solid(solid, node_position(domain, node), domain).distance > 0;
         });
}

/// What stands at a node one outside the box: beyond an opening where the node before it is fluid, else a wall.
std::uint8_t kind_outside(const Domain& domain, std::array<int, 3> node) {
  if (between_plates(domain.kind) && (node[1] < 0 || node[1] >= domain.nodes[1])) {
    if (domain.kind == DomainKind::plates) return wall_at_rest;
    return node[1] < 0 ? lower_plate : upper_plate;
  }
  int faces = 0;
  int opening = -1;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool low = node[a] < 0, high = node[a] >= domain.nodes[a];
    if (!low && !high) continue;
    ++faces;
    opening = domain.opening_of_face()[2 * a + (high ? 1 : 0)];
    node[a] = low ? 0 : domain.nodes[a] - 1;
  }
  if (faces != 1 || opening < 0 || !is_fluid(domain, node)) return wall_at_rest;
  return static_cast<std::uint8_t>(first_opening_kind + opening);
}

}  // namespace

std::array<bool, 3> Domain::periodic() const {
  std::array<bool, 3> flags = periodic_without_openings(*this);
  for (const Opening& opening : openings) flags[axis_of(opening.face)] = false;
  return flags;
}

bool Domain::has_walls() const {
  const std::array<bool, 3> flags = periodic();
  return !solids.empty() || !(flags[0] && flags[1] && flags[2]);
}

bool Domain::is_plain_channel() const {
  return solids.empty() && openings.empty() && (between_plates(kind) || kind == DomainKind::tube);
}

std::array<int, 6> Domain::opening_of_face() const {
  std::array<int, 6> number{-1, -1, -1, -1, -1, -1};
  for (std::size_t n = 0; n < openings.size(); ++n) {
    number[static_cast<std::size_t>(openings[n].face)] = static_cast<int>(n);
  }
  return number;
}

std::uint8_t Domain::node_kind(std::array<int, 3> node) const {
  const std::array<bool, 3> flags = periodic();
  for (std::size_t a = 0; a < 3; ++a) {
    if (flags[a]) node[a] = (node[a] + nodes[a]) % nodes[a];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (node[a] < 0 || node[a] >= nodes[a]) return kind_outside(*this, node);
  }
  return is_fluid(*this, node) ? fluid : wall_at_rest;
}

Vec3 Domain::wall_velocity(std::uint8_t wall_kind) const {
  Vec3 velocity{};
  if (wall_kind == lower_plate) velocity[flow_axis()] = -0.5 * plate_speed;
  if (wall_kind == upper_plate) velocity[flow_axis()] = 0.5 * plate_speed;
  return velocity;
}

WallDistance Domain::wall_distance(const Vec3& position) const {
  WallDistance nearest = distance_to_faces(*this, position);
  if (kind == DomainKind::tube) {
    nearest = nearer(nearest, distance_to_tube(subtract(position, scale(0.5, size())), tube_radius));
  }
  for (const Solid& solid : solids) nearest = nearer(nearest, distance_to_solid(solid, position, *this));
  return nearest;
}

WallDistance Domain::distance_for_cells(const Vec3& position) const {
  WallDistance nearest = wall_distance(position);
  for (const Opening& opening : openings) {
    const std::size_t axis = axis_of(opening.face);
    const double depth = is_high(opening.face) ? size()[axis] - position[axis] : position[axis];
    nearest = nearer(nearest, {depth - cells_keep_from_opening(), inward(opening.face)});
  }
  return nearest;
}

double Domain::fluid_volume() const {
  const Vec3 box = size();
  if (kind == DomainKind::tube) return share_of_fluid * std::numbers::pi * tube_radius * tube_radius * box[2];
  return share_of_fluid * box[0] * box[1] * box[2];
}

double measured_share_of_fluid(const Domain& domain) {
  if (domain.solids.empty()) return 1;
  constexpr int most = 100;
  std::array<int, 3> counts{};
  Vec3 spacing{};
  for (std::size_t a = 0; a < 3; ++a) {
    counts[a] = std::min(2 * domain.nodes[a], most);
    spacing[a] = domain.size()[a] / counts[a];
  }
  Domain empty = domain;
  empty.solids.clear();
  // how much of a brick of the grid is fluid, from the distance of its middle to a wall that is flat there
  const auto share = [&](const WallDistance& wall) {
    double width = 0;
    for (std::size_t a = 0; a < 3; ++a) width += std::abs(wall.normal[a]) * spacing[a];
    return width > 0 ? std::clamp(0.5 + wall.distance / width, 0.0, 1.0) : 1.0;
  };
  double left = 0, whole = 0;
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        const Vec3 at{(i + 0.5) * spacing[0], (j + 0.5) * spacing[1], (k + 0.5) * spacing[2]};
        left += share(domain.wall_distance(at));
        whole += share(empty.wall_distance(at));
      }
    }
  }
  return left / whole;
}

std::vector<double> inlet_profile(const Domain& domain, const Opening& opening) {
  const std::size_t axis = axis_of(opening.face);
  const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const std::array<int, 2> counts{domain.nodes[u], domain.nodes[v]};
  std::vector<bool> open;
  for (int q = 0; q < counts[1]; ++q) {
    for (int p = 0; p < counts[0]; ++p) {
      std::array<int, 3> node{};
      node[axis] = is_high(opening.face) ? domain.nodes[axis] - 1 : 0;
      node[u] = p;
      node[v] = q;
      open.push_back(domain.node_kind(node) == fluid);
    }
  }
  if (opening.profile == Opening::Profile::plug) return {open.begin(), open.end()};
  const std::array<bool, 3> periodic = domain.periodic();
  return section_flow(open, counts, {periodic[u], periodic[v]}).profile;
}

}  // namespace npfem::flow
