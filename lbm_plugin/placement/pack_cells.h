// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "placement/place_cells.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// How far a packing is.
struct PackProgress {
  const char* phase;  ///< "rigid" or "soft"
  int steps;          ///< of that phase
  double overlap;     ///< um: the deepest of a vertex in another cell or a wall
};

struct PackRequest {
  std::vector<int> counts;  ///< cells of each type
  std::uint64_t seed = 1;
  /// Where the cells start, with their vertices, in order of the types; empty: strewn at random. Each is taken for its
  /// rest shape, placed and turned as its vertices are.
  std::vector<CellStart> start;
  int threads = 0;  ///< of the cell solver; 0: OMP_NUM_THREADS
  /// Asked after every step; packing ends where it returns false.
  std::function<bool(const PackProgress&)> goes_on = [](const PackProgress&) { return true; };
};

struct PackedCells {
  std::vector<CellStart> cells;  ///< with positions; by type, within a type along a space-filling curve
  bool interrupted = false;      ///< then there are no cells
  double overlap_before = 0;     ///< um: the deepest of a vertex in another cell, as strewn or as they start
  double least_gap = 0;          ///< um, signed, between surfaces
  double least_wall_gap = 0;     ///< um; infinite without walls
  std::int64_t crossings = 0;    ///< pairs of triangles that pass through each other
  double volume = 0;             ///< um3, of all cells
  double worst_volume_error = 0, worst_area_error = 0;
  int rigid_steps = 0, soft_steps = 0;
};

/// Packs deformable cells of full size: strewn at random through each other, or at given places, pushed apart as rigid
/// bodies (rigid_crowd.h), then settled by the cell solver and its contacts (soft_crowd.h), until no vertex is inside
/// another cell or beyond a wall, no triangles cross and every cell has its volume within 1 %. The same for the same
/// seed. PlacementError, with the haematocrit reached, where that does not come about; std::runtime_error where the
/// cell solver fails.
PackedCells pack_cells(const Domain& domain, std::span<const CellType> types, const PackRequest& request);

}  // namespace npfem::flow
