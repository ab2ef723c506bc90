// SPDX-License-Identifier: MPL-2.0
#include "mesh/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error.h"
#include "mesh/generate.h"

namespace npfem {
namespace {

std::string message_of(const TriangleMesh& mesh) {
  try {
    require_valid_surface(mesh, "m");
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_input);
    return error.what();
  }
  return "";
}

void expect_message(const TriangleMesh& mesh, const std::string& part) {
  const std::string message = message_of(mesh);
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.substr(0, 10), "mesh \"m\": ");
}

TEST(MeshCheck, AcceptsAClosedSurface) {
  EXPECT_EQ(message_of(octahedral_sphere(1)), "");
}

TEST(MeshCheck, NamesWhatIsWrong) {
  const TriangleMesh good = octahedral_sphere(1);
  expect_message({}, "has 0 vertices and 0 triangles");
  expect_message({good.positions, {}}, "has 18 vertices and 0 triangles");

  TriangleMesh mesh = good;
  mesh.positions[7][1] = std::nan("");
  expect_message(mesh, "vertex 7 has a coordinate that is not finite");
  mesh.positions[7][1] = -std::numeric_limits<double>::infinity();
  expect_message(mesh, "vertex 7 has a coordinate that is not finite");

  mesh = good;
  mesh.triangles[5][2] = 18;
  expect_message(mesh, "triangle 5 refers to vertex 18, but there are 18 vertices");
  mesh.triangles[5][2] = -1;
  expect_message(mesh, "triangle 5 refers to vertex -1");

  mesh = good;
  mesh.triangles[5][2] = mesh.triangles[5][1];
  expect_message(mesh, "triangle 5 (vertices ");
  expect_message(mesh, "repeats a vertex");

  mesh = good;
  mesh.positions.push_back({9, 9, 9});
  expect_message(mesh, "vertex 18 belongs to no triangle");
}

TEST(MeshCheck, FindsDegenerateTrianglesAndDuplicates) {
  TriangleMesh mesh = octahedral_sphere(1);
  const Triangle t = mesh.triangles[3];
  const Point& a = mesh.positions[static_cast<std::size_t>(t[0])];
  const Point& b = mesh.positions[static_cast<std::size_t>(t[1])];
  Point& c = mesh.positions[static_cast<std::size_t>(t[2])];
  for (std::size_t i = 0; i < 3; ++i) c[i] = a[i] + 0.25 * (b[i] - a[i]);
  expect_message(mesh, "triangle 3 (vertices ");
  expect_message(mesh, "has no area");

  // A slit: the vertex is doubled, and one of its triangles takes the copy.
  mesh = octahedral_sphere(1);
  mesh.positions.push_back(mesh.positions[2]);
  for (Triangle& triangle : mesh.triangles) {
    if (triangle[0] != 2) continue;
    triangle[0] = 18;
    break;
  }
  expect_message(mesh, "vertices 2 and 18 are at the same position");
}

TEST(MeshCheck, FindsOpenAndNonManifoldEdges) {
  TriangleMesh mesh = octahedral_sphere(1);
  mesh.triangles.pop_back();
  expect_message(mesh, "is open");

  // Two tetrahedra that share an edge.
  const TriangleMesh pair{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                          {{0, 3, 2}, {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 5, 4}, {0, 4, 1}, {0, 1, 5}, {1, 4, 5}}};
  expect_message(pair, "between vertices 1 and 0 of triangle 1");
  expect_message(pair, "is shared by 4 triangles");
}

TEST(MeshCheck, FindsWrongOrientation) {
  TriangleMesh mesh = octahedral_sphere(1);
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  expect_message(mesh, "has the same direction in triangle");

  mesh = octahedral_sphere(1);
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  expect_message(mesh, "the triangles face inwards");
}

TEST(MeshCheck, FindsSheetsThatTouchAndSeparatePieces) {
  const auto tetrahedron_at = [](TriangleMesh& mesh, const Point& tip, double size, int tip_vertex) {
    const int n = static_cast<int>(mesh.positions.size());
    if (tip_vertex < 0) mesh.positions.push_back(tip);
    const int o = tip_vertex < 0 ? n : tip_vertex;
    const int first = static_cast<int>(mesh.positions.size());
    mesh.positions.push_back({tip[0] + size, tip[1], tip[2]});
    mesh.positions.push_back({tip[0], tip[1] + size, tip[2]});
    mesh.positions.push_back({tip[0], tip[1], tip[2] + size});
    const int x = first, y = first + 1, z = first + 2;
    std::vector<Triangle> faces = {{o, y, x}, {o, x, z}, {x, y, z}, {o, z, y}};
    if (size < 0) {
      for (Triangle& t : faces) std::swap(t[0], t[1]);
    }
    mesh.triangles.insert(mesh.triangles.end(), faces.begin(), faces.end());
  };
  TriangleMesh touching;
  tetrahedron_at(touching, {0, 0, 0}, 1, -1);
  tetrahedron_at(touching, {0, 0, 0}, -1, 0);
  expect_message(touching, "touch in vertex 0 only");

  TriangleMesh apart;
  tetrahedron_at(apart, {0, 0, 0}, 1, -1);
  tetrahedron_at(apart, {5, 0, 0}, 1, -1);
  expect_message(apart, "triangle 4 is not connected with triangle 0");
}

}  // namespace
}  // namespace npfem
