// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "placement/packing.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// The cells asked for do not fit into the domain, or were put where they cannot be.
class PlacementError : public std::runtime_error {
 public:
  explicit PlacementError(const std::string& message, int given_cell = -1)
      : std::runtime_error(message), given_cell_(given_cell) {}
  /// Number of the given cell that stands in the way; -1 where it is not about one.
  int given_cell() const { return given_cell_; }

 private:
  int given_cell_;
};

struct PlacementRequest {
  std::vector<int> counts;       ///< cells of each type to be placed at random
  std::vector<CellStart> given;  ///< cells that stand where the user put them
  double gap = 0;                ///< um, between surfaces, and between surfaces and walls
  std::uint64_t seed = 1;
};

struct Placement {
  std::vector<CellStart> cells;  ///< the given ones first, then those placed, by type
  bool grown = false;            ///< random placement jammed, and the cells were grown from small
  int sweeps = 0;                ///< Monte Carlo sweeps of the growth
};

/// Finds a place for every cell, the same for the same seed. First random sequential insertion: each cell in turn is
/// tried at random places and orientations until one is free. Where that jams, all cells start small and grow, while
/// random moves and turns that never bring two surfaces nearer than the gap make room. PlacementError where even that
/// comes to a stop.
Placement place_cells(const Domain& domain, std::span<const CellType> types, const PlacementRequest& request);

}  // namespace npfem::flow
