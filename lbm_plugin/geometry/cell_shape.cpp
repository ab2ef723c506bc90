// SPDX-License-Identifier: MPL-2.0
#include "geometry/cell_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace npfem::flow {
namespace {

using Symmetric = std::array<std::array<double, 3>, 3>;

struct Moments {
  double volume = 0;
  Vec3 centre{};       // centroid
  Symmetric second{};  // integral of (x - centre)(x - centre)^T over the volume
};

/// Sums over the tetrahedra from one vertex to every triangle; of a tetrahedron (0, a, b, c) of volume V the second
/// moments are V/20 (aa^T + bb^T + cc^T + ss^T) with s = a + b + c.
Moments moments_of(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  const Vec3 origin{xyz[0], xyz[1], xyz[2]};
  Moments m;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const auto corner = [&](std::size_t c) {
      const auto v = 3 * static_cast<std::size_t>(triangles[t + c]);
      return subtract({xyz[v], xyz[v + 1], xyz[v + 2]}, origin);
    };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const Vec3 s = add(a, add(b, c));
    const double volume = dot(a, cross(b, c)) / 6;
    m.volume += volume;
    m.centre = add(m.centre, scale(volume / 4, s));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        m.second[i][j] += volume / 20 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]);
      }
    }
  }
  m.centre = scale(1 / m.volume, m.centre);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m.second[i][j] -= m.volume * m.centre[i] * m.centre[j];
  }
  m.centre = add(m.centre, origin);
  return m;
}

struct Eigen {
  double value;
  Vec3 vector;
};

/// Cyclic Jacobi rotations, largest eigenvalue first.
std::array<Eigen, 3> eigen_of(Symmetric a) {
  Symmetric v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr std::array<std::array<std::size_t, 2>, 3> pairs{{{0, 1}, {0, 2}, {1, 2}}};
  for (int sweep = 0; sweep < 20; ++sweep) {
    for (const auto& [p, q] : pairs) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1);
      const double s = t * c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const double vp = v[k][p], vq = v[k][q];
        v[k][p] = c * vp - s * vq;
        v[k][q] = s * vp + c * vq;
      }
    }
  }
  std::array<Eigen, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = {a[i][i], {v[0][i], v[1][i], v[2][i]}};
  std::sort(out.begin(), out.end(), [](const Eigen& x, const Eigen& y) { return x.value > y.value; });
  return out;
}

/// One of the two opposite unit vectors: the one that points up, or else along +y, or else along +x.
Vec3 in_upper_half_space(const Vec3& n) {
  const double leading = n[2] != 0 ? n[2] : (n[1] != 0 ? n[1] : n[0]);
  return leading < 0 ? scale(-1, n) : n;
}

}  // namespace

double enclosed_volume(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  return moments_of(xyz, triangles).volume;
}

CellShape shape_of(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  const Moments m = moments_of(xyz, triangles);
  const std::array<Eigen, 3> axes = eigen_of(m.second);
  const Symmetric& moment = m.second;
  const double inclination = 0.5 * std::atan2(2 * moment[0][1], moment[0][0] - moment[1][1]);
  CellShape shape{m.centre, {}, in_upper_half_space(axes[2].vector), inclination, 0};
  // an ellipsoid of semi-axis s has the second moment V s^2 / 5 along it
  for (std::size_t i = 0; i < 3; ++i) shape.semi_axes[i] = std::sqrt(std::max(0.0, 5 * axes[i].value / m.volume));
  shape.deformation = (shape.semi_axes[0] - shape.semi_axes[2]) / (shape.semi_axes[0] + shape.semi_axes[2]);
  return shape;
}

}  // namespace npfem::flow
