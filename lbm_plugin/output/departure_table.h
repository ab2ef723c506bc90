// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "communicator/communicator.h"
#include "output/table_file.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// left.csv: one line per cell that has left through an opening, in order of time and id.
class DepartureTable {
 public:
  /// Replaces the file by its header line: a run that goes on knows all that have left, and writes them again.
  /// Collective; throws std::runtime_error on every rank where it cannot.
  DepartureTable(Communicator& communicator, std::filesystem::path path);

  /// Appends those that have left since the last call. Collective.
  void append(const Simulation& simulation);

 private:
  TableFile file_;
  std::size_t written_ = 0;
};

}  // namespace npfem::flow
