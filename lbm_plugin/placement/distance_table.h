// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec3.h"

namespace npfem::flow {

/// Signed distance to a closed triangulated surface (um, negative inside), tabulated once on a grid around it, so that
/// asking whether a point is too near costs a look-up. Distances beyond `band` read as +/- band.
class DistanceTable {
 public:
  DistanceTable(std::span<const double> xyz, std::span<const std::int32_t> triangles, double band);

  /// Trilinear between the nodes of the grid; `point` in the frame of the surface.
  double at(const Vec3& point) const;

 private:
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>((k * counts_[1] + j) * counts_[0] + i);
  }
  Vec3 node(int i, int j, int k) const;
  void measure_near(const std::array<Vec3, 3>& triangle);
  void find_inside(std::span<const double> xyz, std::span<const std::int32_t> triangles);

  double band_;
  double spacing_;
  Vec3 origin_;
  std::array<int, 3> counts_;
  std::vector<float> values_;
};

}  // namespace npfem::flow
