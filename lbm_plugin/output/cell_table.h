// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

#include "communicator/communicator.h"
#include "simulation/setup.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// cells.csv: one line per cell and time, in the order of ids: where it is (centroid, unwrapped), how it moves (mean of
/// its vertices), its volume, area and shape, and how its last step ended.
class CellTable {
 public:
  /// Creates the file with its header line. Collective; throws std::runtime_error on every rank where it cannot.
  CellTable(Communicator& communicator, std::filesystem::path path, const Setup& setup);

  /// Appends the cells of all ranks and flushes. Collective.
  void append(std::int64_t step, double time_us, std::span<const CellState> local_cells);

 private:
  void flush();

  Communicator& communicator_;
  std::filesystem::path path_;
  const Setup& setup_;
  std::ofstream file_;  // open on rank 0
};

}  // namespace npfem::flow
