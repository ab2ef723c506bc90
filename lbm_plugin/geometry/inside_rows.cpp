// SPDX-License-Identifier: MPL-2.0
#include "geometry/inside_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

using Triangle = std::array<Vec3, 3>;

/// A place where a row meets the surface. Ordered by row, then along it.
struct Crossing {
  int k, j;
  double x;
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

/// Whether the ray from (y, z) towards larger y crosses the edge. The two ends are taken in an order of their own, so
/// that the answer is the same for both triangles at the edge.
bool crosses(const Vec3& one, const Vec3& other, double y, double z) {
  if ((one[2] > z) == (other[2] > z)) return false;
  const auto& [low, high] = one[2] < other[2] ? std::pair(one, other) : std::pair(other, one);
  return low[1] + (high[1] - low[1]) * ((z - low[2]) / (high[2] - low[2])) > y;
}

bool covers(const Triangle& t, double y, double z) {
  return crosses(t[0], t[1], y, z) != (crosses(t[1], t[2], y, z) != crosses(t[2], t[0], y, z));
}

/// x of the triangle's plane at (y, z), not beyond the triangle, which matters where the plane is nearly along x.
double height_at(const Triangle& t, double y, double z) {
  const Vec3 normal = cross(subtract(t[1], t[0]), subtract(t[2], t[0]));
  const auto [low, high] = std::minmax({t[0][0], t[1][0], t[2][0]});
  const double x = t[0][0] - (normal[1] * (y - t[0][1]) + normal[2] * (z - t[0][2])) / normal[0];
  return std::isfinite(x) ? std::clamp(x, low, high) : low;
}

/// The first node at or beyond a place.
int node_from(double place) {
  return static_cast<int>(std::ceil(place - 0.5));
}

void add_crossings(const Triangle& t, std::vector<Crossing>& crossings) {
  const auto [y_low, y_high] = std::minmax({t[0][1], t[1][1], t[2][1]});
  const auto [z_low, z_high] = std::minmax({t[0][2], t[1][2], t[2][2]});
  for (int k = node_from(z_low); k <= node_from(z_high); ++k) {
    for (int j = node_from(y_low); j <= node_from(y_high); ++j) {
      if (covers(t, j + 0.5, k + 0.5)) crossings.push_back({k, j, height_at(t, j + 0.5, k + 0.5)});
    }
  }
}

}  // namespace

std::vector<NodeRow> rows_inside(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    Triangle t;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto v = 3 * static_cast<std::size_t>(triangles[i + corner]);
      t[corner] = {xyz[v], xyz[v + 1], xyz[v + 2]};
    }
    add_crossings(t, crossings);
  }
  std::sort(crossings.begin(), crossings.end());
  std::vector<NodeRow> rows;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const NodeRow row{node_from(crossings[i].x), node_from(crossings[i + 1].x), crossings[i].j, crossings[i].k};
    if (row.begin < row.end) rows.push_back(row);
  }
  return rows;
}

}  // namespace npfem::flow
