// SPDX-License-Identifier: MPL-2.0
#include "placement/packing.h"

#include <algorithm>
#include <cmath>

#include "geometry/cell_shape.h"

namespace npfem::flow {
namespace {

double radius_about_origin(std::span<const double> xyz) {
  double square = 0;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) square = std::max(square, dot(vector_at(xyz, v), vector_at(xyz, v)));
  return std::sqrt(square);
}

}  // namespace

Packing::Packing(const Domain& domain, std::span<const CellType> types, double largest_gap) : domain_(domain) {
  for (const CellType& type : types) {
    shapes_.push_back({type.shape, DistanceTable(type.shape, type.triangles, largest_gap),
                       radius_about_origin(type.shape), enclosed_volume(type.shape, type.triangles)});
  }
}

Clash Packing::clash(const RigidCell& cell, int itself, double gap) const {
  if (too_near_wall(cell, gap)) return {Clash::With::wall, -1};
  if (images_clash(cell, cell, true, gap)) return {Clash::With::own_image, -1};
  for (std::size_t other = 0; other < cells_.size(); ++other) {
    if (static_cast<int>(other) == itself) continue;
    if (images_clash(cell, cells_[other], false, gap)) return {Clash::With::cell, static_cast<int>(other)};
  }
  return {};
}

bool Packing::too_near_wall(const RigidCell& cell, double gap) const {
  const double required = gap * cell.size;
  if (domain_.distance_for_cells(cell.centre).distance >= shape(cell).radius * cell.size + required) return false;
  const std::span<const double> xyz = shape(cell).xyz;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
    const Vec3 position = add(cell.centre, rotate(cell.rotation, scale(cell.size, vector_at(xyz, v))));
    if (!(domain_.distance_for_cells(position).distance >= required)) return true;
  }
  return false;
}

/// Tries every periodic image of b that can reach a; of a cell and itself, every image but the cell.
bool Packing::images_clash(const RigidCell& a, const RigidCell& b, bool same_cell, double gap) const {
  const double reach = shape(a).radius * a.size + shape(b).radius * b.size + gap * std::min(a.size, b.size);
  const Vec3 box = domain_.size();
  const std::array<bool, 3> periodic = domain_.periodic();
  std::array<int, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    const double separation = a.centre[axis] - b.centre[axis];
    first[axis] = static_cast<int>(std::ceil((separation - reach) / box[axis]));
    last[axis] = static_cast<int>(std::floor((separation + reach) / box[axis]));
  }
  RigidCell image = b;
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) {
        if (same_cell && i == 0 && j == 0 && k == 0) continue;
        image.centre = add(b.centre, {i * box[0], j * box[1], k * box[2]});
        const Vec3 apart = subtract(a.centre, image.centre);
        if (dot(apart, apart) < reach * reach && too_near(a, image, gap)) return true;
      }
    }
  }
  return false;
}

bool Packing::too_near(const RigidCell& a, const RigidCell& b, double gap) const {
  return vertex_too_near(a, b, gap) || vertex_too_near(b, a, gap);
}

/// Looks the vertices of a up in the distance table of b.
bool Packing::vertex_too_near(const RigidCell& a, const RigidCell& b, double gap) const {
  const double required = gap * std::min(a.size, b.size);
  const double reach = shape(b).radius * b.size + required;
  // from the frame of a straight into the frame of b, in units of b's size
  const Vec3 apart = scale(1 / b.size, rotate_back(b.rotation, subtract(a.centre, b.centre)));
  Rotation turn{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      turn[3 * i + j] =
          b.rotation[i] * a.rotation[j] + b.rotation[3 + i] * a.rotation[3 + j] + b.rotation[6 + i] * a.rotation[6 + j];
    }
  }
  const double ratio = a.size / b.size;
  const double reach_squared = (reach / b.size) * (reach / b.size);
  const std::span<const double> xyz = shape(a).xyz;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
    const Vec3 position = add(apart, scale(ratio, rotate(turn, vector_at(xyz, v))));
    if (dot(position, position) >= reach_squared) continue;
    if (shape(b).distance.at(position) * b.size < required) return true;
  }
  return false;
}

}  // namespace npfem::flow
