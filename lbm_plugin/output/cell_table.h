// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "communicator/communicator.h"
#include "output/table_file.h"
#include "simulation/setup.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// cells.csv: one line per cell and time, in the order of ids: where it is (centroid, unwrapped), how it moves (mean of
/// its vertices), its volume, area and shape, how much its membrane is stretched, and how its
/// last step ended.
class CellTable {
 public:
  /// Creates the file with its header line; with `resumed_at` goes on behind the lines up to that step. Collective;
  /// throws std::runtime_error on every rank where it cannot.
  CellTable(Communicator& communicator, std::filesystem::path path, const Setup& setup,
            std::optional<std::int64_t> resumed_at = {});

  /// Appends the cells of all ranks and flushes. Collective.
  void append(std::int64_t step, double time_us, std::span<const CellState> local_cells);

  /// Of the lines that a resumed run has found; -1 without any.
  std::int64_t last_step() const { return file_.last_step(); }

 private:
  Communicator& communicator_;
  const Setup& setup_;
  TableFile file_;
};

}  // namespace npfem::flow
