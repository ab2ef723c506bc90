// SPDX-License-Identifier: MPL-2.0
#include "mesh/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "error.h"
#include "mesh/geometry.h"
#include "mesh/point_math.h"
#include "mesh/topology.h"
#include "quantity.h"

namespace npfem {
namespace {

/// Throws the errors of one mesh.
class Checker {
 public:
  Checker(const TriangleMesh& mesh, std::string_view name) : mesh_(mesh), name_(name) {}

  void well_formed() const {
    if (mesh_.positions.empty() || mesh_.triangles.empty()) {
      fail("has " + std::to_string(mesh_.positions.size()) + " vertices and " + std::to_string(mesh_.triangles.size()) +
           " triangles; a surface needs some of both");
    }
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
      for (const double x : mesh_.positions[i]) {
        if (!std::isfinite(x)) fail("vertex " + std::to_string(i) + " has a coordinate that is not finite");
      }
    }
    const int count = static_cast<int>(mesh_.positions.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const int vertex : mesh_.triangles[t]) {
        if (vertex >= 0 && vertex < count) continue;
        fail("triangle " + std::to_string(t) + " refers to vertex " + std::to_string(vertex) + ", but there are " +
             std::to_string(count) + " vertices, numbered from 0");
      }
    }
  }

  void triangles() const {
    const double mean = surface_area(mesh_) / static_cast<double>(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [i, j, k] = mesh_.triangles[t];
      if (i == j || j == k || k == i) fail(triangle_words(t) + " repeats a vertex; remove it");
      if (!(triangle_area(mesh_, static_cast<int>(t)) > smallest_area_fraction * mean)) {
        fail(triangle_words(t) + " has no area; remove it or move one of its vertices");
      }
    }
  }

  void vertices() const {
    std::vector<int> order(mesh_.positions.size());
    std::iota(order.begin(), order.end(), 0);
    const auto position = [this](int i) { return mesh_.positions[static_cast<std::size_t>(i)]; };
    std::sort(order.begin(), order.end(),
              [&](int i, int j) { return std::pair(position(i), i) < std::pair(position(j), j); });
    for (std::size_t n = 1; n < order.size(); ++n) {
      if (position(order[n - 1]) != position(order[n])) continue;
      fail("vertices " + std::to_string(order[n - 1]) + " and " + std::to_string(order[n]) +
           " are at the same position; merge them");
    }
    std::vector<bool> is_used(mesh_.positions.size(), false);
    for (const Triangle& t : mesh_.triangles) {
      for (const int vertex : t) is_used[static_cast<std::size_t>(vertex)] = true;
    }
    const auto unused = std::find(is_used.begin(), is_used.end(), false);
    if (unused != is_used.end()) {
      fail("vertex " + std::to_string(unused - is_used.begin()) + " belongs to no triangle; remove it");
    }
  }

  void edges() const {
    const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh_);
    for (std::size_t i = 0; i < half_edges.size();) {
      const HalfEdge& h = half_edges[i];
      const auto is_other = [&h](const HalfEdge& g) { return std::minmax(g.a, g.b) != std::minmax(h.a, h.b); };
      const auto end = std::find_if(half_edges.begin() + static_cast<std::ptrdiff_t>(i), half_edges.end(), is_other);
      const std::size_t count = static_cast<std::size_t>(end - half_edges.begin()) - i;
      const std::string words = "the edge between vertices " + std::to_string(h.a) + " and " + std::to_string(h.b) +
                                " of triangle " + std::to_string(h.triangle);
      if (count == 1) fail(words + " is open (no other triangle shares it); close the surface");
      if (count > 2)
        fail(words + " is shared by " + std::to_string(count) + " triangles; a surface has two at an edge");
      if (half_edges[i + 1].a == h.a) {
        fail(words + " has the same direction in triangle " + std::to_string(half_edges[i + 1].triangle) +
             "; orient all triangles counter-clockwise seen from outside");
      }
      i += count;
    }
  }

  /// The triangles at a vertex must form one fan, and the surface one piece:
  /// both by walking over shared edges.
  void pieces() const {
    const std::vector<Hinge> hinges = find_hinges(mesh_);
    std::vector<int> corner_parent(3 * mesh_.triangles.size()), parent(mesh_.triangles.size());
    std::iota(corner_parent.begin(), corner_parent.end(), 0);
    std::iota(parent.begin(), parent.end(), 0);
    for (const Hinge& h : hinges) {
      join(parent, h.triangle_a, h.triangle_b);
      for (const int vertex : {h.a, h.b})
        join(corner_parent, corner(h.triangle_a, vertex), corner(h.triangle_b, vertex));
    }
    std::vector<int> fan(mesh_.positions.size(), -1);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const int vertex : mesh_.triangles[t]) {
        const int root = find_root(corner_parent, corner(static_cast<int>(t), vertex));
        int& first = fan[static_cast<std::size_t>(vertex)];
        if (first >= 0 && first != root) {
          fail("two sheets of the surface touch in vertex " + std::to_string(vertex) + " only; split the vertex");
        }
        first = root;
      }
      if (find_root(parent, static_cast<int>(t)) != find_root(parent, 0)) {
        fail("triangle " + std::to_string(t) + " is not connected with triangle 0; a cell is one closed surface");
      }
    }
  }

  void orientation() const {
    if (signed_volume(mesh_) > 0) return;
    fail("its volume is " + text::format_number(signed_volume(mesh_)) +
         " um3: the triangles face inwards; reverse the vertex order of all of "
         "them");
  }

 private:
  static constexpr double smallest_area_fraction =
      1e-12;  // of the mean triangle: beyond it no rest shape can be inverted

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Status::bad_input, "mesh \"" + std::string(name_) + "\": " + message);
  }

  std::string triangle_words(std::size_t t) const {
    const auto [i, j, k] = mesh_.triangles[t];
    return "triangle " + std::to_string(t) + " (vertices " + std::to_string(i) + ", " + std::to_string(j) + ", " +
           std::to_string(k) + ")";
  }

  int corner(int triangle, int vertex) const {
    const Triangle& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
    return 3 * triangle + static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
  }

  static int find_root(std::vector<int>& parent, int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      int& up = parent[static_cast<std::size_t>(i)];
      up = parent[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }

  static void join(std::vector<int>& parent, int i, int j) {
    parent[static_cast<std::size_t>(find_root(parent, i))] = find_root(parent, j);
  }

  const TriangleMesh& mesh_;
  std::string_view name_;
};

}  // namespace

void require_well_formed(const TriangleMesh& mesh, std::string_view name) {
  Checker(mesh, name).well_formed();
}

void require_valid_surface(const TriangleMesh& mesh, std::string_view name) {
  const Checker checker(mesh, name);
  checker.well_formed();
  checker.triangles();
  checker.vertices();
  checker.edges();
  checker.pieces();
  checker.orientation();
}

}  // namespace npfem
