// SPDX-License-Identifier: MPL-2.0
// Who is whose neighbour on a surface. All orders are functions of the triangle list alone.
#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace npfem {

/// Two triangles that share an edge. Triangle A holds the edge as a -> b in its cyclic order, so A = (a, b, c) and
/// B = (b, a, d) up to rotation, both counter-clockwise seen from outside.
struct Hinge {
  int a, b;                    ///< the edge
  int c;                       ///< vertex of triangle A opposite the edge
  int d;                       ///< vertex of triangle B opposite the edge
  int triangle_a, triangle_b;  ///< triangle_a < triangle_b
};

/// One side of an edge: a -> b in the cyclic order of `triangle`, where `opposite` is the third vertex.
struct HalfEdge {
  int a, b;
  int triangle;
  int opposite;
};

/// All half-edges, those of one edge side by side (sorted by smaller vertex, larger vertex, triangle).
std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh);

/// One hinge per interior edge, in the order of triangle A and, within it, of its edges 01, 12, 20. An edge that does
/// not have exactly two triangles of opposite sense gives no hinge (require_valid_surface refuses such meshes).
std::vector<Hinge> find_hinges(const TriangleMesh& mesh);

/// Every edge once, as (smaller vertex, larger vertex), sorted.
std::vector<std::array<int, 2>> find_edges(const TriangleMesh& mesh);

/// The neighbours of each vertex, sorted.
std::vector<std::vector<int>> find_neighbours(const TriangleMesh& mesh);

/// The neighbours of each vertex of a closed surface in order around it, counter-clockwise seen from outside, beginning
/// with the smallest number.
std::vector<std::vector<int>> find_rings(const TriangleMesh& mesh);

}  // namespace npfem
