// SPDX-License-Identifier: MPL-2.0
#pragma once

// The geometry of one rank, sorted for the solver: rows of neighbouring fluid nodes, which are updated without a
// branch, and the links from fluid to solid nodes, which are bounced afterwards.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "communicator/decomposition.h"
#include "communicator/local_grid.h"
#include "lattice/geometry.h"

namespace npfem::flow {

// Fluid nodes next to each other along x.
struct FluidRun {
  std::ptrdiff_t first = 0;  // index in the local grid
  std::int32_t length = 0;
  std::int32_t ix = 0, iy = 0, iz = 0;  // local indices of the first
};

// Direction `direction` leads from the fluid node to a solid one, a part of wall `wall`.
struct WallLink {
  std::ptrdiff_t fluid = 0;  // index in the local grid
  std::int32_t direction = 0;
  std::int32_t wall = 0;
};

class NodeMap {
 public:
  // std::invalid_argument where a node has no such wall or the fluid reaches beyond a face that is not periodic.
  NodeMap(const Decomposition& decomposition, const LocalGrid& grid, const Geometry& geometry);

  NodeType type(std::ptrdiff_t index) const { return types_[std::size_t(index)]; }
  // By plane of constant z, 0 <= iz < size(2), so that threads can share the work plane by plane.
  std::span<const FluidRun> runs(int iz) const { return plane_of(runs_, run_begin_, iz); }
  std::span<const WallLink> links(int iz) const { return plane_of(links_, link_begin_, iz); }
  std::int64_t fluid_nodes() const { return fluid_nodes_; }  // own ones

 private:
  template <class T>
  static std::span<const T> plane_of(const std::vector<T>& all, const std::vector<std::size_t>& begin, int iz) {
    const auto z = std::size_t(iz);
    return {all.data() + begin[z], begin[z + 1] - begin[z]};
  }
  void find_types(const Decomposition& decomposition, const LocalGrid& grid, const Geometry& geometry);
  void find_runs(const LocalGrid& grid);
  void find_links(const LocalGrid& grid);

  std::vector<NodeType> types_;  // halo included
  std::vector<FluidRun> runs_;
  std::vector<WallLink> links_;
  std::vector<std::size_t> run_begin_, link_begin_;
  std::int64_t fluid_nodes_ = 0;
};

}  // namespace npfem::flow
