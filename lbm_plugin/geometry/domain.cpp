// SPDX-License-Identifier: MPL-2.0
#include "geometry/domain.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

constexpr std::uint8_t fluid = 0;
constexpr std::uint8_t wall_at_rest = 1;
constexpr std::uint8_t lower_plate = 2;
constexpr std::uint8_t upper_plate = 3;

bool between_plates(DomainKind kind) {
  return kind == DomainKind::shear_box || kind == DomainKind::plates;
}

WallDistance distance_to_plates(double y, double height) {
  return y < 0.5 * height ? WallDistance{y, {0, 1, 0}} : WallDistance{height - y, {0, -1, 0}};
}

WallDistance distance_to_tube(const Vec3& from_axis, double radius) {
  const double r = std::hypot(from_axis[0], from_axis[1]);
  // on the axis every direction leads to the wall; one is taken
  if (r == 0) return {radius, {1, 0, 0}};
  return {radius - r, {-from_axis[0] / r, -from_axis[1] / r, 0}};
}

}  // namespace

std::array<bool, 3> Domain::periodic() const {
  switch (kind) {
    case DomainKind::periodic_box:
      return {true, true, true};
    case DomainKind::shear_box:
    case DomainKind::plates:
      return {true, false, true};
    case DomainKind::tube:
      return {false, false, true};
  }
  return {};
}

std::uint8_t Domain::node_kind(std::array<int, 3> node) const {
  if (between_plates(kind)) {
    const bool moving = kind == DomainKind::shear_box;
    if (node[1] < 0) return moving ? lower_plate : wall_at_rest;
    if (node[1] >= nodes[1]) return moving ? upper_plate : wall_at_rest;
    return fluid;
  }
  if (kind == DomainKind::tube) {
    const double x = (node[0] + 0.5 - 0.5 * nodes[0]) * dx;
    const double y = (node[1] + 0.5 - 0.5 * nodes[1]) * dx;
    const bool in_box = node[0] >= 0 && node[0] < nodes[0] && node[1] >= 0 && node[1] < nodes[1];
    return in_box && x * x + y * y < tube_radius * tube_radius ? fluid : wall_at_rest;
  }
  return fluid;
}

Vec3 Domain::wall_velocity(std::uint8_t wall_kind) const {
  if (wall_kind == lower_plate) return {-0.5 * plate_speed, 0, 0};
  if (wall_kind == upper_plate) return {0.5 * plate_speed, 0, 0};
  return {0, 0, 0};
}

WallDistance Domain::wall_distance(const Vec3& position) const {
  const Vec3 box = size();
  if (between_plates(kind)) return distance_to_plates(position[1], box[1]);
  if (kind == DomainKind::tube) return distance_to_tube(subtract(position, scale(0.5, box)), tube_radius);
  return {std::numeric_limits<double>::infinity(), {0, 0, 0}};
}

double Domain::fluid_volume() const {
  const Vec3 box = size();
  if (kind == DomainKind::tube) return std::numbers::pi * tube_radius * tube_radius * box[2];
  return box[0] * box[1] * box[2];
}

}  // namespace npfem::flow
