// SPDX-License-Identifier: MPL-2.0
#include "lattice/node_map.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

namespace npfem::flow {
namespace {

std::string place(const Index3& node) {
  return "node (" + std::to_string(node[0]) + ", " + std::to_string(node[1]) + ", " + std::to_string(node[2]) + ")";
}

void check_type(NodeType type, const Index3& node, bool outside, std::size_t boundaries) {
  if (outside && type == kFluid) {
    throw std::invalid_argument(place(node) +
                                " is fluid but lies beyond a face that is not periodic; there it must be a wall");
  }
  if (type != kFluid && std::size_t(type) > boundaries) {
    throw std::invalid_argument(place(node) + " belongs to boundary " + std::to_string(type - 1) + ", but there are " +
                                std::to_string(boundaries) + " boundaries");
  }
}

}  // namespace

// One strip before the own box, and room behind it for the halo and for the strip that follows the last with fluid.
NodeMap::NodeMap(const Decomposition& decomposition, int rank, const Geometry& geometry)
    : own_(decomposition.box(rank)), row_length_(static_cast<std::size_t>((size(0) + kStrip - 1) / kStrip + 2)) {
  find_types(decomposition, geometry);
  number_strips();
  find_fluid_strips(decomposition, rank);
  find_own_strips();
}

void NodeMap::find_types(const Decomposition& decomposition, const Geometry& geometry) {
  types_.resize(rows_in(0) * rows_in(1) * rows_in(2));
  for (int iz = -kHalo; iz < size(2) + kHalo; ++iz) {
    for (int iy = -kHalo; iy < size(1) + kHalo; ++iy) {
      for (int ix = -kHalo; ix < size(0) + kHalo; ++ix) {
        Index3 node{ix, iy, iz};
        bool outside = false;
        for (int axis = 0; axis < 3; ++axis) {
          int& i = node[std::size_t(axis)];
          const int n = decomposition.nodes()[std::size_t(axis)];
          // The second layer beyond a face repeats the first.
          i = std::clamp(decomposition.wrap(axis, i + own_.begin[std::size_t(axis)]), -1, n);
          outside = outside || i < 0 || i == n;
        }
        const NodeType type = geometry.node_type(node[0], node[1], node[2]);
        check_type(type, node, outside, geometry.boundaries.size());
        types_[type_index(ix, iy, iz)] = type;
        const bool is_own = ix >= 0 && ix < size(0) && iy >= 0 && iy < size(1) && iz >= 0 && iz < size(2);
        if (is_own && type == kFluid) ++fluid_nodes_;
      }
    }
  }
}

std::uint8_t NodeMap::fluid_in(int x_strip, int iy, int iz) const {
  unsigned fluid = 0;
  for (int l = 0; l < kStrip; ++l) {
    const int ix = x_strip * kStrip + l;
    if (ix < size(0) && type(ix, iy, iz) == kFluid) fluid |= 1U << l;
  }
  return static_cast<std::uint8_t>(fluid);
}

void NodeMap::number_strips() {
  constexpr std::int32_t wanted = 0, unwanted = -1;
  strips_.assign(row_length_ * rows_in(1) * rows_in(2), unwanted);
  const int strips_across = static_cast<int>(row_length_) - 2;
  for (int iz = 0; iz < size(2); ++iz) {
    for (int iy = 0; iy < size(1); ++iy) {
      for (int s = 0; s < strips_across; ++s) {
        if (fluid_in(s, iy, iz) == 0) continue;
        for (int dz = -kHalo; dz <= kHalo; ++dz) {
          for (int dy = -kHalo; dy <= kHalo; ++dy) {
            std::fill_n(strips_.begin() + static_cast<std::ptrdiff_t>(row_of(iy + dy, iz + dz)) + s, 3, wanted);
          }
        }
      }
    }
  }
  std::int32_t next = 0;
  for (std::int32_t& strip : strips_) {
    if (strip == unwanted) continue;
    if (next == std::numeric_limits<NodeNumber>::max() / kStrip) {
      throw std::invalid_argument("one rank would hold more than 2^31 nodes; use more ranks");
    }
    strip = next++;
  }
  stored_ = static_cast<std::size_t>(next);
}

// Rows that a plane may have in the order of visits, so that four planes of them fit into the second-level cache beside
// other things: a strip holds 1.2 kB in double precision.
int NodeMap::rows_in_tile() const {
  constexpr std::size_t cached_strips = 600;
  return static_cast<int>(std::max(std::size_t{1}, cached_strips / (4 * row_length_)));
}

void NodeMap::find_fluid_strips(const Decomposition& decomposition, int rank) {
  Cuts cut{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const int beyond = decomposition.neighbour(rank, axis, side == 0 ? -1 : 1);
      cut[std::size_t(axis)][std::size_t(side)] = beyond >= 0 && beyond != rank;
    }
  }
  std::vector<std::size_t> near_rows, inside_rows;
  const int tile = rows_in_tile();
  for (int first = 0; first < size(1); first += tile) {
    for (int iz = 0; iz < size(2); ++iz) {
      for (int iy = first; iy < std::min(first + tile, size(1)); ++iy) {
        near_rows.push_back(near_neighbours_.strips.size());
        inside_rows.push_back(inside_.strips.size());
        add_fluid_row(iy, iz, cut);
      }
    }
  }
  near_neighbours_.mark_rows(near_rows);
  inside_.mark_rows(inside_rows);
}

void NodeMap::add_fluid_row(int iy, int iz, const Cuts& cut) {
  const auto at_cut = [&](std::size_t axis, int first, int last) {
    return (cut[axis][0] && first == 0) || (cut[axis][1] && last == size(int(axis)) - 1);
  };
  for (int s = 0; s < static_cast<int>(row_length_) - 2; ++s) {
    const std::uint8_t fluid = fluid_in(s, iy, iz);
    if (fluid == 0) continue;
    const auto strip = [&](int dy, int dz) { return row(iy + dy, iz + dz)[s + 1]; };
    const bool near =
        at_cut(0, s * kStrip, std::min((s + 1) * kStrip, size(0)) - 1) || at_cut(1, iy, iy) || at_cut(2, iz, iz);
    (near ? near_neighbours_ : inside_)
        .strips.push_back(
            {strip(0, 0), strip(1, 0), strip(-1, 0), strip(0, 1), strip(0, -1), strip(1, 1), strip(1, -1), fluid});
  }
}

void NodeMap::SortedStrips::mark_rows(const std::vector<std::size_t>& first_of_rows) {
  const std::size_t count = strips.size();
  if (count > 0) strips.insert(strips.end(), kStripsAhead, strips.back());
  for (std::size_t r = 0; r < first_of_rows.size(); ++r) {
    const std::size_t end = r + 1 < first_of_rows.size() ? first_of_rows[r + 1] : count;
    if (end > first_of_rows[r]) rows.emplace_back(strips.data() + first_of_rows[r], end - first_of_rows[r]);
  }
}

void NodeMap::find_own_strips() {
  for (int iz = 0; iz < size(2); ++iz) {
    for (int iy = 0; iy < size(1); ++iy) {
      for (int s = 0; s < static_cast<int>(row_length_) - 2; ++s) {
        const std::int32_t strip = row(iy, iz)[s + 1];
        if (strip >= 0) own_strips_.push_back({strip, fluid_in(s, iy, iz)});
      }
    }
  }
}

}  // namespace npfem::flow
