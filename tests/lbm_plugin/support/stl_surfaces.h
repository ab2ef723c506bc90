// SPDX-License-Identifier: MPL-2.0
#pragma once

// Surfaces as STL text.

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace stl {

using Point = std::array<double, 3>;
using Triangle = std::array<Point, 3>;

inline std::string text(const std::vector<Triangle>& triangles) {
  std::string out = "solid test\n";
  for (const Triangle& t : triangles) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const Point& p : t) {
      char line[128];
      std::snprintf(line, sizeof line, "   vertex %.9g %.9g %.9g\n", p[0], p[1], p[2]);
      out += line;
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid test\n";
}

/// The same triangles as binary STL.
inline std::string binary(const std::vector<Triangle>& triangles) {
  std::string out = "solid in name only";
  out.resize(80, ' ');
  const auto append = [&out](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    for (int n = 0; n < 3; ++n) append(0.0f);
    for (const Point& p : t) {
      for (const double x : p) append(static_cast<float>(x));
    }
    append(std::uint16_t{0});
  }
  return out;
}

/// The faces of a box, counter-clockwise seen from outside: 12 triangles, low x first, then high x, low y, ...
inline std::vector<Triangle> box(const Point& low, const Point& high) {
  std::vector<Triangle> triangles;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool at_high : {false, true}) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::array<Point, 4> corner{};
      for (std::size_t c = 0; c < 4; ++c) {
        corner[c][axis] = at_high ? high[axis] : low[axis];
        corner[c][u] = c == 1 || c == 2 ? high[u] : low[u];
        corner[c][v] = c >= 2 ? high[v] : low[v];
      }
      if (!at_high) std::swap(corner[1], corner[3]);
      triangles.push_back({corner[0], corner[1], corner[2]});
      triangles.push_back({corner[0], corner[2], corner[3]});
    }
  }
  return triangles;
}

/// A ball as a grid of longitudes and latitudes.
inline std::vector<Triangle> sphere(const Point& centre, double radius, int around) {
  const auto at = [&](int longitude, int latitude) {
    const double phi = 2 * std::numbers::pi * (longitude % around) / around;
    const double theta = std::numbers::pi * latitude / (around / 2);
    const double r = latitude == 0 || latitude == around / 2 ? 0.0 : std::sin(theta);
    return Point{centre[0] + radius * r * std::cos(phi), centre[1] + radius * r * std::sin(phi),
                 centre[2] + radius * std::cos(theta)};
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < around / 2; ++j) {
      if (j > 0) triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      if (j < around / 2 - 1) triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  return triangles;
}

/// The mantle of a tube along z from z = 0 to `length`, without lids, seen from outside counter-clockwise.
inline std::vector<Triangle> mantle(const Point& axis, double radius, double length, int around, int along) {
  const auto at = [&](int i, int k) {
    const double phi = 2 * std::numbers::pi * (i % around) / around;
    return Point{axis[0] + radius * std::cos(phi), axis[1] + radius * std::sin(phi), length * k / along};
  };
  std::vector<Triangle> triangles;
  for (int k = 0; k < along; ++k) {
    for (int i = 0; i < around; ++i) {
      triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      triangles.push_back({at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return triangles;
}

}  // namespace stl
