// SPDX-License-Identifier: MPL-2.0
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh/generate.h"

namespace npfem {
namespace {

/// True when `triangle` holds a -> b in its cyclic order.
bool holds(const Triangle& t, int a, int b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

TEST(Hinges, OfATetrahedron) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const std::vector<Hinge> hinges = find_hinges(mesh);
  ASSERT_EQ(hinges.size(), 6u);
  const Hinge& first = hinges[0];  // edge 0 -> 2 of triangle 0; triangle 3 = (0, 3, 2) holds 2 -> 0
  EXPECT_EQ((std::array{first.a, first.b, first.c, first.d, first.triangle_a, first.triangle_b}),
            (std::array{0, 2, 1, 3, 0, 3}));
}

TEST(Hinges, CoverEachEdgeOnceWithTheStatedSense) {
  for (const TriangleMesh& mesh : {octahedral_sphere(3), icosahedral_sphere(2)}) {
    const std::vector<Hinge> hinges = find_hinges(mesh);
    ASSERT_EQ(hinges.size(), mesh.triangles.size() * 3 / 2);
    std::set<std::pair<int, int>> seen;
    int last = 0;
    for (const Hinge& h : hinges) {
      EXPECT_TRUE(seen.insert(std::minmax(h.a, h.b)).second);
      const Triangle& a = mesh.triangles[static_cast<std::size_t>(h.triangle_a)];
      const Triangle& b = mesh.triangles[static_cast<std::size_t>(h.triangle_b)];
      EXPECT_TRUE(holds(a, h.a, h.b) && holds(a, h.b, h.c));
      EXPECT_TRUE(holds(b, h.b, h.a) && holds(b, h.a, h.d));
      EXPECT_LT(h.triangle_a, h.triangle_b);
      EXPECT_LE(last, h.triangle_a) << "in the order of triangle A";
      last = h.triangle_a;
    }
  }
}

TEST(Hinges, OpenEdgesGiveNone) {
  const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(find_hinges(square).size(), 1u);
  EXPECT_EQ(find_edges(square).size(), 5u);
  const TriangleMesh flipped{square.positions, {{0, 1, 2}, {0, 3, 2}}};
  EXPECT_EQ(find_hinges(flipped).size(), 0u) << "both triangles hold 2 -> 0: there is no dihedral angle";
}

TEST(Edges, FulfilEuler) {
  const TriangleMesh mesh = octahedral_sphere(3);
  const auto edges = find_edges(mesh);
  EXPECT_EQ(edges.size(), 768u);
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
  const auto neighbours = find_neighbours(mesh);
  EXPECT_EQ(std::count_if(neighbours.begin(), neighbours.end(), [](const auto& n) { return n.size() == 4; }), 6);
  EXPECT_EQ(std::count_if(neighbours.begin(), neighbours.end(), [](const auto& n) { return n.size() == 6; }), 252);
}

TEST(Rings, RunCounterClockwiseAroundEachVertex) {
  const TriangleMesh mesh = octahedral_sphere(2);
  const auto rings = find_rings(mesh), neighbours = find_neighbours(mesh);
  for (std::size_t v = 0; v < rings.size(); ++v) {
    auto sorted = rings[v];
    EXPECT_EQ(sorted.front(), *std::min_element(sorted.begin(), sorted.end()));
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const int a = rings[v][i], b = rings[v][(i + 1) % sorted.size()], c = static_cast<int>(v);
      const bool is_triangle = std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                                           [&](const Triangle& t) { return holds(t, c, a) && holds(t, a, b); });
      EXPECT_TRUE(is_triangle) << c << " " << a << " " << b;
    }
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, neighbours[v]);
  }
}

}  // namespace
}  // namespace npfem
