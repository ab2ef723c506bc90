// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

namespace npfem::flow {

/// A vertex of a cell, by the global id of the cell.
struct VertexId {
  int cell;
  int vertex;
  friend bool operator==(const VertexId&, const VertexId&) = default;
};

/// The vertices among which one rank finds contacts, in order of (cell, vertex): those it is asked about, and all
/// others of triangles that they may touch.
struct ContactVertices {
  std::vector<VertexId> id;
  std::vector<double> position;  ///< xyz, um, unwrapped: where the vertices are expected at the end of the step
  std::vector<int> held;         ///< whose contacts this rank finds, as ascending indices; each vertex is held by one
};

}  // namespace npfem::flow
