// SPDX-License-Identifier: MPL-2.0
// Cells for the placement and output tests, made here so that these tests need no cell solver.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/vec3.h"
#include "simulation/setup.h"

namespace npfem::flow::testing {

/// Unit sphere from the octahedron by midpoint subdivision.
inline CellType unit_sphere(int level) {
  std::vector<Vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::int32_t, 3>> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int n = 0; n < level; ++n) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [entry, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (fresh) {
        const Vec3 m = add(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]);
        points.push_back(scale(1 / norm(m), m));
      }
      return entry->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  CellType type;
  for (const Vec3& p : points) type.shape.insert(type.shape.end(), p.begin(), p.end());
  for (const auto& f : faces) type.triangles.insert(type.triangles.end(), f.begin(), f.end());
  return type;
}

inline CellType sphere(double radius, int level = 3) {
  CellType type = unit_sphere(level);
  type.name = "sphere";
  for (double& x : type.shape) x *= radius;
  return type;
}

/// Evans & Fung (1972), 7.82 um across.
inline CellType red_cell(int level = 3) {
  CellType type = unit_sphere(level);
  type.name = "rbc";
  for (std::size_t v = 0; v < type.shape.size(); v += 3) {
    const double q = type.shape[v] * type.shape[v] + type.shape[v + 1] * type.shape[v + 1];
    type.shape[v] *= 3.91;
    type.shape[v + 1] *= 3.91;
    type.shape[v + 2] *= 0.5 * 3.91 * (0.207161 + 2.002558 * q - 1.122762 * q * q);
  }
  return type;
}

inline CellType platelet(int level = 2) {
  CellType type = unit_sphere(level);
  type.name = "platelet";
  for (std::size_t v = 0; v < type.shape.size(); v += 3) {
    type.shape[v] *= 1.8;
    type.shape[v + 1] *= 1.8;
    type.shape[v + 2] *= 0.55;
  }
  return type;
}

}  // namespace npfem::flow::testing
