// SPDX-License-Identifier: MPL-2.0
#include "coupling/crowding.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "geometry/vec3.h"
#include "immersed_boundary/stencil.h"

namespace npfem::flow {
namespace {

/// The known vertices by the node that holds them.
class VerticesByNode {
 public:
  VerticesByNode(const KnownVertices& known, const Decomposition& grid) : known_(known), grid_(grid) {
    for (std::size_t v = 0; v < known.id.size(); ++v) {
      const Index3 node = node_in_grid(grid, position(v));
      at_[grid.global_id(node[0], node[1], node[2])].push_back(v);
    }
  }

  /// Whether a vertex of another cell is within one node spacing; the cell's own image is not another.
  bool has_foreign_near(std::size_t v) const {
    const Index3 node = node_at(position(v));
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const auto found =
              at_.find(grid_.global_id(node_in_grid(grid_, 0, node[0] + i), node_in_grid(grid_, 1, node[1] + j),
                                       node_in_grid(grid_, 2, node[2] + k)));
          if (found == at_.end()) continue;
          for (const std::size_t other : found->second) {
            if (known_.id[other].cell != known_.id[v].cell && is_near(v, other)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  Vec3 position(std::size_t v) const { return vector_at(known_.in_nodes, v); }

  bool is_near(std::size_t a, std::size_t b) const {
    Vec3 apart = subtract(position(a), position(b));
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (grid_.periodic(axis)) apart[i] -= grid_.nodes()[i] * std::round(apart[i] / grid_.nodes()[i]);
    }
    return dot(apart, apart) <= 1;
  }

  const KnownVertices& known_;
  const Decomposition& grid_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> at_;
};

}  // namespace

std::vector<double> crowded_vertices(const KnownVertices& known, const Decomposition& decomposition,
                                     const Domain& domain) {
  const VerticesByNode vertices(known, decomposition);
  const bool has_walls = domain.has_walls();
  std::vector<double> crowded;
  for (const int held : known.held) {
    const auto v = static_cast<std::size_t>(held);
    const Vec3 position = vector_at(known.position, v);
    const bool at_wall = has_walls && domain.wall_distance(position).distance <= domain.dx;
    crowded.push_back(at_wall || vertices.has_foreign_near(v) ? 1 : 0);
  }
  return crowded;
}

}  // namespace npfem::flow
