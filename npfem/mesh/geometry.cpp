// SPDX-License-Identifier: MPL-2.0
#include "mesh/geometry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/point_math.h"

namespace npfem {
namespace {

const Point& at(const TriangleMesh& mesh, int vertex) {
  return mesh.positions[static_cast<std::size_t>(vertex)];
}

/// Six times the signed volume of the tetrahedron (origin, triangle).
double six_volumes(const TriangleMesh& mesh, const Triangle& t) {
  return dot(at(mesh, t[0]), cross(at(mesh, t[1]), at(mesh, t[2])));
}

}  // namespace

double triangle_area(const TriangleMesh& mesh, int triangle) {
  return 0.5 * norm(area_vector(mesh, mesh.triangles[static_cast<std::size_t>(triangle)]));
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * norm(area_vector(mesh, t));
  return area;
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const Triangle& t : mesh.triangles) volume += six_volumes(mesh, t) / 6;
  return volume;
}

double reduced_volume(const TriangleMesh& mesh) {
  return 6 * std::sqrt(std::numbers::pi) * signed_volume(mesh) / std::pow(surface_area(mesh), 1.5);
}

Point volume_centroid(const TriangleMesh& mesh) {
  Point moment{};
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    const double part = six_volumes(mesh, t) / 6;
    const Point corners = sum(at(mesh, t[0]), sum(at(mesh, t[1]), at(mesh, t[2])));
    moment = sum(moment, scaled(part / 4, corners));
    volume += part;
  }
  return scaled(1 / volume, moment);
}

Point mean_position(const TriangleMesh& mesh) {
  Point total{};
  for (const Point& p : mesh.positions) total = sum(total, p);
  return scaled(1 / static_cast<double>(mesh.positions.size()), total);
}

Point extents(const TriangleMesh& mesh) {
  Point low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Point& p : mesh.positions) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  return difference(high, low);
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.positions.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const double third = norm(area_vector(mesh, t)) / 6;
    for (const int vertex : t) areas[static_cast<std::size_t>(vertex)] += third;
  }
  return areas;
}

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  EdgeLengths lengths{std::numeric_limits<double>::infinity(), 0, 0};
  const auto edges = find_edges(mesh);
  for (const auto& [a, b] : edges) {
    const double length = norm(difference(at(mesh, a), at(mesh, b)));
    lengths.min = std::min(lengths.min, length);
    lengths.max = std::max(lengths.max, length);
    lengths.mean += length / static_cast<double>(edges.size());
  }
  return lengths;
}

PrincipalAxes principal_axes(const TriangleMesh& mesh) {
  // Over a tetrahedron (0, a, b, c) of volume v: integral of x x^T = v/20 (a a^T + b b^T + c c^T + s s^T), s = a + b +
  // c.
  const Point centre = volume_centroid(mesh);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Triangle& t : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) {
      const Point p = difference(at(mesh, t[static_cast<std::size_t>(i)]), centre);
      corners.col(i) = Eigen::Vector3d(p[0], p[1], p[2]);
    }
    const Eigen::Vector3d s = corners.rowwise().sum();
    moments += corners.determinant() / 120 * (corners * corners.transpose() + s * s.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  const Eigen::Vector3d values = solver.eigenvalues();
  Eigen::Matrix3d axes = solver.eigenvectors();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  PrincipalAxes result{};
  for (int i = 0; i < 3; ++i) {
    result.second_moment[static_cast<std::size_t>(i)] = values[i];
    result.axis[static_cast<std::size_t>(i)] = {axes(0, i), axes(1, i), axes(2, i)};
  }
  return result;
}

double dihedral_angle(const TriangleMesh& mesh, const Hinge& hinge) {
  const Point normal_a = area_vector(mesh, {hinge.a, hinge.b, hinge.c});
  const Point normal_b = area_vector(mesh, {hinge.b, hinge.a, hinge.d});
  const Point edge = difference(at(mesh, hinge.b), at(mesh, hinge.a));
  return std::atan2(dot(cross(normal_a, normal_b), edge) / norm(edge), dot(normal_a, normal_b));
}

}  // namespace npfem
