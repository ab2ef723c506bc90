// SPDX-License-Identifier: MPL-2.0
#include "mesh/generate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "error.h"
#include "mesh/point_math.h"
#include "nearest.h"
#include "quantity.h"

namespace npfem {
namespace {

constexpr double evans_fung_c[] = {0.207161, 2.002558, -1.122762};
constexpr double red_cell_diameter = 7.82;  // um, Evans & Fung 1972
constexpr double platelet_diameter = 3.6;   // um
constexpr double platelet_thickness = 1.1;  // um
constexpr double unit_sphere_diameter = 2;  // um
constexpr double largest_diameter = 1e6;    // um

TriangleMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Splits each triangle into four at the midpoints of its edges.
TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.positions, {}};
  std::map<std::pair<int, int>, int> midpoints;
  const auto midpoint = [&](int i, int j) {
    const auto [it, is_new] = midpoints.try_emplace(std::minmax(i, j), static_cast<int>(fine.positions.size()));
    if (is_new) {
      const Point& a = mesh.positions[static_cast<std::size_t>(it->first.first)];
      const Point& b = mesh.positions[static_cast<std::size_t>(it->first.second)];
      fine.positions.push_back(scaled(0.5, sum(a, b)));
    }
    return it->second;
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const int ij = midpoint(i, j), jk = midpoint(j, k), ki = midpoint(k, i);
    fine.triangles.insert(fine.triangles.end(), {{i, ij, ki}, {ij, j, jk}, {ki, jk, k}, {ij, jk, ki}});
  }
  return fine;
}

void project_to_unit_sphere(TriangleMesh& mesh) {
  for (Point& p : mesh.positions) p = scaled(1 / norm(p), p);
}

TriangleMesh subdivided_sphere(TriangleMesh mesh, int level) {
  if (level < 0 || level > max_mesh_level) {
    throw Error(Status::bad_input, "mesh level " + std::to_string(level) + " is outside 0 to " +
                                       std::to_string(max_mesh_level) +
                                       " (a red cell of level 3 has 258 "
                                       "vertices, each level four times more)");
  }
  project_to_unit_sphere(mesh);
  for (int i = 0; i < level; ++i) {
    mesh = subdivided(mesh);
    project_to_unit_sphere(mesh);
  }
  return mesh;
}

void require_size(double size_um, const char* what) {
  if (size_um > 0 && size_um <= largest_diameter) return;
  throw Error(Status::bad_input, std::string("the ") + what + " of the mesh is " + text::format_number(size_um) +
                                     " um; it must be greater than 0 and at most 1e6 um");
}

TriangleMesh scaled_mesh(TriangleMesh mesh, double factor) {
  for (Point& p : mesh.positions) p = scaled(factor, p);
  return mesh;
}

struct Shape {
  const char* name;
  double natural_diameter;  ///< um
  TriangleMesh (*make)(int level, double diameter_um);
};

constexpr Shape shapes[] = {
    {"rbc", red_cell_diameter, [](int level, double diameter) { return evans_fung_cell(level, diameter); }},
    {"platelet", platelet_diameter,
     [](int level, double diameter) {
       return oblate_spheroid(level, diameter, diameter * platelet_thickness / platelet_diameter);
     }},
    {"sphere", unit_sphere_diameter,
     [](int level, double diameter) { return scaled_mesh(octahedral_sphere(level), diameter / 2); }},
    {"icosphere", unit_sphere_diameter,
     [](int level, double diameter) { return scaled_mesh(icosahedral_sphere(level), diameter / 2); }},
};

}  // namespace

TriangleMesh octahedral_sphere(int level) {
  return subdivided_sphere(octahedron(), level);
}

TriangleMesh icosahedral_sphere(int level) {
  return subdivided_sphere(icosahedron(), level);
}

TriangleMesh evans_fung_cell(int level, double diameter_um) {
  require_size(diameter_um, "diameter");
  TriangleMesh mesh = octahedral_sphere(level);
  const double radius = diameter_um / 2;
  for (Point& s : mesh.positions) {
    const double q = s[0] * s[0] + s[1] * s[1];
    const double half_thickness = 0.5 * (evans_fung_c[0] + evans_fung_c[1] * q + evans_fung_c[2] * q * q);
    s = {radius * s[0], radius * s[1], radius * s[2] * half_thickness};
  }
  return mesh;
}

TriangleMesh oblate_spheroid(int level, double diameter_um, double thickness_um) {
  require_size(diameter_um, "diameter");
  require_size(thickness_um, "thickness");
  TriangleMesh mesh = octahedral_sphere(level);
  for (Point& s : mesh.positions) s = {diameter_um / 2 * s[0], diameter_um / 2 * s[1], thickness_um / 2 * s[2]};
  return mesh;
}

std::vector<std::string> mesh_shapes() {
  std::vector<std::string> names;
  for (const Shape& shape : shapes) names.push_back(shape.name);
  return names;
}

TriangleMesh generate_mesh(std::string_view shape_name, int level, double diameter_um) {
  for (const Shape& shape : shapes) {
    if (shape_name != shape.name) continue;
    if (diameter_um == 0) return shape.make(level, shape.natural_diameter);
    require_size(diameter_um, "diameter");
    return shape.make(level, diameter_um);
  }
  throw Error(Status::unknown_name,
              "unknown mesh shape \"" + std::string(shape_name) + '"' + text::suggestion(shape_name, mesh_shapes()));
}

}  // namespace npfem
