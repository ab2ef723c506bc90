// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "communicator/communicator.h"

namespace npfem::flow {

/// A table of comma-separated values that grows with the run: rank 0 writes, lines begin with the step. Calls are
/// collective and throw std::runtime_error on every rank where the file cannot be written.
class TableFile {
 public:
  /// Creates the file with its header line. With `resumed_at` the lines of a file that is there are kept up to that
  /// step, and what a stopped run wrote later is cut off; the file is replaced whole.
  TableFile(Communicator& communicator, std::filesystem::path path, const std::string& header,
            std::optional<std::int64_t> resumed_at);

  /// Whole lines, of rank 0.
  void append(const std::string& lines);

  /// Of the lines found in a file that is continued; -1 without any. The same on every rank.
  std::int64_t last_step() const { return last_step_; }

 private:
  Communicator& communicator_;
  std::filesystem::path path_;
  std::ofstream file_;  // open on rank 0
  std::int64_t last_step_ = -1;
};

}  // namespace npfem::flow
