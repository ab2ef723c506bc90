// SPDX-License-Identifier: MPL-2.0
#include "placement/distance_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "placement/triangle_distance.h"

namespace npfem::flow {
namespace {

constexpr int nodes_across = 80;  // of the largest extent: 0.1 um for a red cell

struct Extent {
  Vec3 low, high;
};

Extent extent_of(std::span<const double> xyz) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Extent e{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (std::size_t n = 0; n < xyz.size(); ++n) {
    e.low[n % 3] = std::min(e.low[n % 3], xyz[n]);
    e.high[n % 3] = std::max(e.high[n % 3], xyz[n]);
  }
  return e;
}

std::array<Vec3, 3> corners(std::span<const double> xyz, std::span<const std::int32_t> triangles, std::size_t t) {
  std::array<Vec3, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto v = 3 * static_cast<std::size_t>(triangles[3 * t + c]);
    out[c] = {xyz[v], xyz[v + 1], xyz[v + 2]};
  }
  return out;
}

/// Height at which the line (x, y, anything) crosses the triangle; false where it does not.
bool crossing(const std::array<Vec3, 3>& t, double x, double y, double& height) {
  const auto side = [&](const Vec3& p, const Vec3& q) {
    return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  };
  const double w2 = side(t[0], t[1]);
  const double w0 = side(t[1], t[2]);
  const double w1 = side(t[2], t[0]);
  if (!((w0 > 0 && w1 > 0 && w2 > 0) || (w0 < 0 && w1 < 0 && w2 < 0))) return false;
  height = (w0 * t[0][2] + w1 * t[1][2] + w2 * t[2][2]) / (w0 + w1 + w2);
  return true;
}

}  // namespace

DistanceTable::DistanceTable(std::span<const double> xyz, std::span<const std::int32_t> triangles, double band)
    : band_(band) {
  const Extent extent = extent_of(xyz);
  const Vec3 size = subtract(extent.high, extent.low);
  spacing_ = std::max({size[0], size[1], size[2]}) / nodes_across;
  const double margin = band + spacing_;
  for (std::size_t a = 0; a < 3; ++a) {
    origin_[a] = extent.low[a] - margin;
    counts_[a] = static_cast<int>(std::ceil((size[a] + 2 * margin) / spacing_)) + 1;
  }
  values_.assign(index(0, 0, counts_[2]), static_cast<float>(band));
  for (std::size_t t = 0; t < triangles.size() / 3; ++t) measure_near(corners(xyz, triangles, t));
  find_inside(xyz, triangles);
}

Vec3 DistanceTable::node(int i, int j, int k) const {
  return {origin_[0] + i * spacing_, origin_[1] + j * spacing_, origin_[2] + k * spacing_};
}

void DistanceTable::measure_near(const std::array<Vec3, 3>& t) {
  std::array<int, 3> first{}, last{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax({t[0][a], t[1][a], t[2][a]});
    first[a] = std::max(0, static_cast<int>(std::floor((low - band_ - origin_[a]) / spacing_)));
    last[a] = std::min(counts_[a] - 1, static_cast<int>(std::ceil((high + band_ - origin_[a]) / spacing_)));
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        float& value = values_[index(i, j, k)];
        value = std::min(value, static_cast<float>(distance_to_triangle(node(i, j, k), t[0], t[1], t[2])));
      }
    }
  }
}

/// A node is inside where a line along z from far below has crossed the surface an odd number of times.
void DistanceTable::find_inside(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  // the lines stand beside the nodes by less than matters, so that they miss the vertices and edges of symmetric meshes
  const double aside_x = 1.37e-5 * spacing_;
  const double aside_y = 2.71e-5 * spacing_;
  std::vector<std::vector<double>> heights(static_cast<std::size_t>(counts_[0] * counts_[1]));
  for (std::size_t t = 0; t < triangles.size() / 3; ++t) {
    const std::array<Vec3, 3> corner = corners(xyz, triangles, t);
    const auto [x_low, x_high] = std::minmax({corner[0][0], corner[1][0], corner[2][0]});
    const auto [y_low, y_high] = std::minmax({corner[0][1], corner[1][1], corner[2][1]});
    const auto node_at = [&](double x, std::size_t axis) { return static_cast<int>((x - origin_[axis]) / spacing_); };
    for (int j = node_at(y_low, 1); j <= node_at(y_high, 1) + 1; ++j) {
      for (int i = node_at(x_low, 0); i <= node_at(x_high, 0) + 1; ++i) {
        double height = 0;
        const Vec3 foot = node(i, j, 0);
        if (crossing(corner, foot[0] + aside_x, foot[1] + aside_y, height)) {
          heights[static_cast<std::size_t>(j * counts_[0] + i)].push_back(height);
        }
      }
    }
  }
  for (int k = 0; k < counts_[2]; ++k) {
    for (int j = 0; j < counts_[1]; ++j) {
      for (int i = 0; i < counts_[0]; ++i) {
        const std::vector<double>& above = heights[static_cast<std::size_t>(j * counts_[0] + i)];
        const double z = node(i, j, k)[2];
        const auto below = std::count_if(above.begin(), above.end(), [z](double h) { return h < z; });
        if (below % 2 == 1) values_[index(i, j, k)] *= -1;
      }
    }
  }
}

double DistanceTable::at(const Vec3& point) const {
  std::array<int, 3> cell{};
  Vec3 f{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double s = (point[a] - origin_[a]) / spacing_;
    if (!(s >= 0 && s < counts_[a] - 1)) return band_;
    cell[a] = static_cast<int>(s);
    f[a] = s - cell[a];
  }
  const float* v = values_.data() + index(cell[0], cell[1], cell[2]);
  const auto row = static_cast<std::ptrdiff_t>(counts_[0]);
  const std::ptrdiff_t plane = row * counts_[1];
  const auto along_x = [&](std::ptrdiff_t at) {
    return static_cast<double>(v[at]) * (1 - f[0]) + static_cast<double>(v[at + 1]) * f[0];
  };
  const double low = along_x(0) * (1 - f[1]) + along_x(row) * f[1];
  const double high = along_x(plane) * (1 - f[1]) + along_x(plane + row) * f[1];
  return low * (1 - f[2]) + high * f[2];
}

}  // namespace npfem::flow
