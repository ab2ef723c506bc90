// SPDX-License-Identifier: MPL-2.0
#include "contact/vertex_grid.h"

#include <algorithm>
#include <cmath>

#include "lattice/lattice.h"

namespace npfem::flow {

VertexGrid::VertexGrid(const Decomposition& decomposition, const Box& own, double reach) {
  // A little wider than the reach: a pair exactly within it must not be lost to the rounding of the cube's number.
  const double least_edge = std::max(reach, 0.25) * (1.0 + 1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const bool periodic = decomposition.periodic(axis);
    const int all = decomposition.nodes()[a];
    const int window = own.size(axis) + 2 * Lattice::kHalo;
    const bool whole = periodic && window >= all;
    const double length = whole ? all : window;
    const int cubes = std::max(1, static_cast<int>(length / least_edge));
    axes_[a] = {whole ? 0.0 : static_cast<double>(own.begin[a] - Lattice::kHalo), periodic ? all : 0.0, length / cubes,
                cubes, whole};
  }
}

int VertexGrid::cube_on(const Axis& axis, double position) const {
  double along = position - axis.origin;
  if (axis.period > 0) along -= axis.period * std::floor(along / axis.period);
  // Vertices that have left the window through a wall stay in its last cubes.
  return static_cast<int>(std::clamp(std::floor(along / axis.edge), 0.0, static_cast<double>(axis.cubes - 1)));
}

VertexGrid::Neighbours VertexGrid::neighbours(std::size_t axis, int cube) const {
  const int cubes = axes_[axis].cubes;
  Neighbours near{{cube, 0, 0}, 1};
  for (const int other : {cube - 1, cube + 1}) {
    if (!axes_[axis].wraps && (other < 0 || other >= cubes)) continue;
    const int wrapped = (other + cubes) % cubes;
    const auto end = near.cube.begin() + near.count;
    if (std::find(near.cube.begin(), end, wrapped) != end) continue;
    near.cube[static_cast<std::size_t>(near.count++)] = wrapped;
  }
  return near;
}

/// Counting sort by cube.
void VertexGrid::fill(std::span<const double> in_nodes) {
  const std::size_t count = in_nodes.size() / 3;
  cube_of_.resize(count);
  sorted_.resize(count);
  begin_.assign(number_of({0, 0, axes_[2].cubes}) + 1, 0);
  for (std::size_t v = 0; v < count; ++v) {
    for (std::size_t a = 0; a < 3; ++a) cube_of_[v][a] = cube_on(axes_[a], in_nodes[3 * v + a]);
    ++begin_[number_of(cube_of_[v])];
  }
  for (std::size_t cube = 1; cube < begin_.size(); ++cube) begin_[cube] += begin_[cube - 1];
  // begin_ now says where each cube ends; filled from the back, it says where each begins.
  for (std::size_t v = count; v-- > 0;) sorted_[--begin_[number_of(cube_of_[v])]] = static_cast<int>(v);
}

}  // namespace npfem::flow
