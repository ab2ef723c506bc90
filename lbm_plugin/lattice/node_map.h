// SPDX-License-Identifier: MPL-2.0
#pragma once

// Which nodes one rank stores, and where. Eight nodes in a row along x make a *strip*, the unit in which the solver
// works. Stored are the strips that hold fluid and those around them that the solver or the immersed boundary may touch
// (one strip further along x, two rows further in y and z); what lies deeper in a solid takes no memory. Strips are
// numbered along x, then y, then z, so that strips next to each other in a row have successive numbers.
//
// Local indices count from the first own node of the rank; around the own box lie kHalo layers of nodes that copy other
// ranks, or the other side of a periodic box, or stand for the boundary.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "communicator/decomposition.h"
#include "lattice/geometry.h"

namespace npfem::flow {

// A stored node: 8 * strip + place in the strip.
using NodeNumber = std::int32_t;

// A strip with own fluid nodes, and the strips of the six rows around it that its populations come from and go to. Each
// of these is followed by the strip next to it along x.
struct FluidStrip {
  std::int32_t strip;
  std::int32_t y_up, y_down, z_up, z_down, yz_up, y_up_z_down;
  std::uint8_t fluid;  // bit l: node l is fluid and this rank's own
};

// A strip with own nodes, fluid or not.
struct OwnStrip {
  std::int32_t strip;
  std::uint8_t fluid;  // as above
};

class NodeMap {
 public:
  static constexpr int kHalo = 2;
  static constexpr int kStrip = 8;  // nodes in a strip

  // std::invalid_argument where a node has no such boundary or the fluid reaches beyond a face that is not periodic.
  NodeMap(const Decomposition& decomposition, int rank, const Geometry& geometry);
  NodeMap(const NodeMap&) = delete;
  NodeMap(NodeMap&&) = default;

  const Box& own() const { return own_; }  // in global indices
  int size(int axis) const { return own_.size(axis); }

  // -kHalo <= index < size + kHalo in each direction. kNoNode where the node is not stored.
  static constexpr NodeNumber kNoNode = -1;
  NodeNumber number(int ix, int iy, int iz) const {
    const int x = ix + kStrip;  // own nodes begin with the second strip of a row
    const std::int32_t strip = strips_[row_of(iy, iz) + static_cast<std::size_t>(x / kStrip)];
    return strip < 0 ? kNoNode : strip * kStrip + x % kStrip;
  }
  // Of a node that is not stored: that of the boundary it lies in.
  NodeType type(int ix, int iy, int iz) const { return types_[type_index(ix, iy, iz)]; }

  std::size_t strips() const { return stored_; }
  // Of the row at (iy, iz), by x / 8 + 1: number of the strip, -1 where it is not stored. strips_per_row() of them.
  const std::int32_t* row(int iy, int iz) const { return strips_.data() + row_of(iy, iz); }
  std::size_t strips_per_row() const { return row_length_; }

  // Behind each strip of a row lie at least so many others, of the rows visited next: so far the solver looks ahead.
  static constexpr int kStripsAhead = 2;
  // The strips with nodes next to another rank's, and the rest, in rows along x. Rows follow each other along y over a
  // few rows, then along z, then further along y, so that the planes between which populations pass stay in the cache.
  using Row = std::span<const FluidStrip>;
  std::span<const Row> rows_near_neighbours() const { return near_neighbours_.rows; }
  std::span<const Row> rows_inside() const { return inside_.rows; }
  std::span<const OwnStrip> own_strips() const { return own_strips_; }
  std::int64_t fluid_nodes() const { return fluid_nodes_; }  // own ones

  // body(local index ix, iy, iz) for every own fluid node, in order of global ids.
  template <class Body>
  void for_each_fluid_node(Body body) const {
    for (int iz = 0; iz < size(2); ++iz) {
      for (int iy = 0; iy < size(1); ++iy) {
        for (int ix = 0; ix < size(0); ++ix) {
          if (type(ix, iy, iz) == kFluid) body(ix, iy, iz);
        }
      }
    }
  }

 private:
  std::size_t rows_in(int axis) const { return static_cast<std::size_t>(size(axis) + 2 * kHalo); }
  std::size_t row_of(int iy, int iz) const {
    return row_length_ * (static_cast<std::size_t>(iy + kHalo) + rows_in(1) * static_cast<std::size_t>(iz + kHalo));
  }
  std::size_t type_index(int ix, int iy, int iz) const {
    return static_cast<std::size_t>(ix + kHalo) +
           rows_in(0) * (static_cast<std::size_t>(iy + kHalo) + rows_in(1) * static_cast<std::size_t>(iz + kHalo));
  }
  void find_types(const Decomposition& decomposition, const Geometry& geometry);
  void number_strips();
  void find_fluid_strips(const Decomposition& decomposition, int rank);
  // [axis][side]: another rank lies beyond this face.
  using Cuts = std::array<std::array<bool, 2>, 3>;
  void add_fluid_row(int iy, int iz, const Cuts& cut);
  int rows_in_tile() const;
  void find_own_strips();
  std::uint8_t fluid_in(int x_strip, int iy, int iz) const;

  Box own_;
  std::size_t row_length_;            // strips in a row of the table, stored or not
  std::vector<NodeType> types_;       // halo included
  std::vector<std::int32_t> strips_;  // number by place
  std::size_t stored_ = 0;
  // Strips sorted by row, and where the rows lie among them.
  struct SortedStrips {
    std::vector<FluidStrip> strips;
    std::vector<Row> rows;
    void mark_rows(const std::vector<std::size_t>& first_of_rows);
  };
  SortedStrips near_neighbours_, inside_;
  std::vector<OwnStrip> own_strips_;
  std::int64_t fluid_nodes_ = 0;
};

}  // namespace npfem::flow
