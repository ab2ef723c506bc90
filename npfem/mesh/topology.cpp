// SPDX-License-Identifier: MPL-2.0
#include "mesh/topology.h"

#include <algorithm>
#include <tuple>

namespace npfem {
namespace {

std::array<int, 2> edge_of(const HalfEdge& h) {
  return {std::min(h.a, h.b), std::max(h.a, h.b)};
}

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    const int triangle = static_cast<int>(t);
    half_edges.insert(half_edges.end(), {{i, j, triangle, k}, {j, k, triangle, i}, {k, i, triangle, j}});
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& g, const HalfEdge& h) {
    return std::tuple(edge_of(g), g.triangle, g.a) < std::tuple(edge_of(h), h.triangle, h.a);
  });
  return half_edges;
}

std::vector<Hinge> find_hinges(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
  std::vector<Hinge> hinges;
  for (std::size_t i = 0; i < half_edges.size();) {
    std::size_t end = i + 1;
    while (end < half_edges.size() && edge_of(half_edges[end]) == edge_of(half_edges[i])) ++end;
    const HalfEdge& g = half_edges[i];
    const HalfEdge& h = half_edges[end - 1];
    const bool is_interior = end - i == 2 && g.a == h.b;
    if (is_interior) hinges.push_back({g.a, g.b, g.opposite, h.opposite, g.triangle, h.triangle});
    i = end;
  }
  // In the order of triangle A, then of the edge within it.
  const auto rank = [&mesh](const Hinge& hinge) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(hinge.triangle_a)];
    const int position = hinge.a == t[0] ? 0 : (hinge.a == t[1] ? 1 : 2);
    return std::pair(hinge.triangle_a, position);
  };
  std::sort(hinges.begin(), hinges.end(), [&](const Hinge& g, const Hinge& h) { return rank(g) < rank(h); });
  return hinges;
}

std::vector<std::array<int, 2>> find_edges(const TriangleMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  for (const HalfEdge& h : sorted_half_edges(mesh)) {
    if (edges.empty() || edges.back() != edge_of(h)) edges.push_back(edge_of(h));
  }
  return edges;
}

std::vector<std::vector<int>> find_neighbours(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> neighbours(mesh.positions.size());
  for (const auto& [a, b] : find_edges(mesh)) {
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  return neighbours;
}

std::vector<std::vector<int>> find_rings(const TriangleMesh& mesh) {
  // Triangle (v, a, b) says that around v the neighbour b follows a.
  std::vector<std::vector<std::pair<int, int>>> follows(mesh.positions.size());
  for (const auto& [i, j, k] : mesh.triangles) {
    follows[static_cast<std::size_t>(i)].emplace_back(j, k);
    follows[static_cast<std::size_t>(j)].emplace_back(k, i);
    follows[static_cast<std::size_t>(k)].emplace_back(i, j);
  }
  std::vector<std::vector<int>> rings(mesh.positions.size());
  for (std::size_t v = 0; v < rings.size(); ++v) {
    auto& pairs = follows[v];
    std::sort(pairs.begin(), pairs.end());
    for (auto at = pairs.begin(); at != pairs.end() && rings[v].size() < pairs.size();) {
      rings[v].push_back(at->first);
      at = std::lower_bound(pairs.begin(), pairs.end(), std::pair(at->second, -1));
    }
  }
  return rings;
}

}  // namespace npfem
