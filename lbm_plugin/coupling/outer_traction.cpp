// SPDX-License-Identifier: MPL-2.0
#include "coupling/outer_traction.h"

#include <algorithm>

#include "geometry/vec3.h"
#include "immersed_boundary/stencil.h"

namespace npfem::flow {
namespace {

Vec3 times(const SymmetricTensor& t, const Vec3& n) {
  return {t[0] * n[0] + t[3] * n[1] + t[4] * n[2], t[3] * n[0] + t[1] * n[1] + t[5] * n[2],
          t[4] * n[0] + t[5] * n[1] + t[2] * n[2]};
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// By vertex: itself and those it shares an edge with.
std::vector<std::vector<std::size_t>> neighbourhoods(const CellType& type) {
  std::vector<std::vector<std::size_t>> around(type.shape.size() / 3);
  for (std::size_t v = 0; v < around.size(); ++v) around[v].push_back(v);
  for (std::size_t i = 0; i < type.triangles.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    // Every edge of a closed surface is met once in each direction.
    around[static_cast<std::size_t>(type.triangles[i])].push_back(static_cast<std::size_t>(type.triangles[next]));
  }
  return around;
}

}  // namespace

OuterTraction::OuterTraction(const Setup& setup, const Units& units, Communicator& communicator, const Lattice& lattice)
    : setup_(setup), units_(units), communicator_(communicator), lattice_(lattice) {
  for (const CellType& type : setup.types) around_.push_back(neighbourhoods(type));
}

void OuterTraction::sample(const CellPopulation& cells, std::span<const double> positions,
                           std::span<const double> crowded, std::vector<double>& force) {
  find_patches(cells, positions);
  std::vector<Index3> nodes;
  for (std::size_t v = 0; v < patches_.size(); ++v) {
    nodes.push_back(outermost_node(scale(1.0 / units_.dx, vector_at(positions, v)), patches_[v].normal));
  }
  const std::vector<NodeStress> stress = stresses_at(nodes, lattice_, communicator_);
  raw_.resize(positions.size());
  force.resize(positions.size());
  for (const CellPopulation::Cell& cell : cells.cells()) {
    load_cell(cell.first_vertex, cells.vertices_of(cell.type), stress, crowded);
    take_medians(around_[static_cast<std::size_t>(cell.type)], cell.first_vertex, force);
  }
}

void OuterTraction::find_patches(const CellPopulation& cells, std::span<const double> positions) {
  patches_.clear();
  for (const CellPopulation::Cell& cell : cells.cells()) {
    const auto part = positions.subspan(3 * cell.first_vertex, 3 * cells.vertices_of(cell.type));
    const auto found = vertex_patches(part, setup_.types[static_cast<std::size_t>(cell.type)].triangles);
    patches_.insert(patches_.end(), found.begin(), found.end());
  }
}

/// Position in node spacings. kNoSuchNode where there is no fluid around.
Index3 OuterTraction::outermost_node(const Vec3& position, const Vec3& normal) const {
  const Decomposition& grid = lattice_.decomposition();
  const Index3 first = Stencil<4>(position).first;
  Index3 outermost = kNoSuchNode;
  double farthest = 0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const Index3 node{first[0] + i, first[1] + j, first[2] + k};
        const double height = dot(subtract({node[0] + 0.5, node[1] + 0.5, node[2] + 0.5}, position), normal);
        if (outermost != kNoSuchNode && height <= farthest) continue;
        const Index3 there{grid.wrap(0, node[0]), grid.wrap(1, node[1]), grid.wrap(2, node[2])};
        const Index3& size = grid.nodes();
        const bool in_grid = Box{{0, 0, 0}, size}.contains(there[0], there[1], there[2]);
        if (!in_grid || setup_.domain.node_kind(there) != 0) continue;
        outermost = there;
        farthest = height;
      }
    }
  }
  return outermost;
}

/// raw_ of one cell.
void OuterTraction::load_cell(std::size_t first, std::size_t vertices, std::span<const NodeStress> stress,
                              std::span<const double> crowded) {
  const auto at = [&](std::size_t v) { return crowded[v] != 0 ? NodeStress{} : stress[v]; };
  double load = 0, area = 0;
  for (std::size_t v = first; v < first + vertices; ++v) {
    load += at(v).pressure * patches_[v].area;
    area += patches_[v].area;
  }
  const double mean = area > 0 ? load / area : 0;
  for (std::size_t v = first; v < first + vertices; ++v) {
    const VertexPatch& patch = patches_[v];
    const NodeStress local = at(v);
    const Vec3 traction = subtract(times(local.viscous, patch.normal), scale(local.pressure - mean, patch.normal));
    for (std::size_t axis = 0; axis < 3; ++axis) raw_[3 * v + axis] = units_.pressure() * patch.area * traction[axis];
  }
}

void OuterTraction::take_medians(const std::vector<std::vector<std::size_t>>& around, std::size_t first,
                                 std::vector<double>& force) const {
  std::vector<double> values;
  for (std::size_t v = 0; v < around.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values.clear();
      for (const std::size_t neighbour : around[v]) values.push_back(raw_[3 * (first + neighbour) + axis]);
      force[3 * (first + v) + axis] = median(values);
    }
  }
}

}  // namespace npfem::flow
