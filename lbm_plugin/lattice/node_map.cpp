// SPDX-License-Identifier: MPL-2.0
#include "lattice/node_map.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace npfem::flow {
namespace {

std::string place(const Index3& node) {
  return "node (" + std::to_string(node[0]) + ", " + std::to_string(node[1]) + ", " + std::to_string(node[2]) + ")";
}

void check_type(NodeType type, const Index3& node, bool outside, std::size_t walls) {
  if (outside && type == kFluid) {
    throw std::invalid_argument(place(node) +
                                " is fluid but lies beyond a face that is not periodic; there it must be a wall");
  }
  if (type != kFluid && std::size_t(type) > walls) {
    throw std::invalid_argument(place(node) + " belongs to boundary " + std::to_string(type - 1) + ", but there are " +
                                std::to_string(walls) + " boundaries");
  }
}

}  // namespace

NodeMap::NodeMap(const Decomposition& decomposition, const LocalGrid& grid, const Geometry& geometry) {
  find_types(decomposition, grid, geometry);
  find_runs(grid);
  find_links(grid);
}

void NodeMap::find_types(const Decomposition& decomposition, const LocalGrid& grid, const Geometry& geometry) {
  const int halo = grid.halo();
  types_.resize(std::size_t(grid.nodes()));
  for (int iz = -halo; iz < grid.size(2) + halo; ++iz) {
    for (int iy = -halo; iy < grid.size(1) + halo; ++iy) {
      for (int ix = -halo; ix < grid.size(0) + halo; ++ix) {
        Index3 node{ix, iy, iz};
        bool outside = false;
        for (int axis = 0; axis < 3; ++axis) {
          int& i = node[std::size_t(axis)];
          const int n = decomposition.nodes()[std::size_t(axis)];
          // The second layer beyond a face repeats the first.
          i = std::clamp(decomposition.wrap(axis, i + grid.own().begin[std::size_t(axis)]), -1, n);
          outside = outside || i < 0 || i == n;
        }
        const NodeType type = geometry.node_type(node[0], node[1], node[2]);
        check_type(type, node, outside, geometry.boundaries.size());
        types_[std::size_t(grid.index(ix, iy, iz))] = type;
      }
    }
  }
}

void NodeMap::find_runs(const LocalGrid& grid) {
  for (int iz = 0; iz < grid.size(2); ++iz) {
    run_begin_.push_back(runs_.size());
    for (int iy = 0; iy < grid.size(1); ++iy) {
      bool in_run = false;
      for (int ix = 0; ix < grid.size(0); ++ix) {
        const std::ptrdiff_t n = grid.index(ix, iy, iz);
        const bool fluid = type(n) == kFluid;
        if (fluid && !in_run) runs_.push_back({n, 0, ix, iy, iz});
        if (fluid) ++runs_.back().length;
        in_run = fluid;
      }
    }
  }
  run_begin_.push_back(runs_.size());
  for (const FluidRun& run : runs_) fluid_nodes_ += run.length;
}

void NodeMap::find_links(const LocalGrid& grid) {
  for (int iz = 0; iz < grid.size(2); ++iz) {
    link_begin_.push_back(links_.size());
    for (const FluidRun& run : runs(iz)) {
      for (std::ptrdiff_t n = run.first; n < run.first + run.length; ++n) {
        for (int i = 1; i < d3q19::kDirections; ++i) {
          const NodeType beyond = type(n + grid.offset(d3q19::kVelocity[std::size_t(i)]));
          if (beyond != kFluid) links_.push_back({n, i, beyond - 1});
        }
      }
    }
  }
  link_begin_.push_back(links_.size());
}

}  // namespace npfem::flow
