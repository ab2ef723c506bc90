// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace npfem::flow {

/// The folder `checkpoints` of a run: checkpoint_<step, 12 digits>.npfem each, and failed_<step>.npfem, the last state
/// of a run that became unstable, which is kept to be looked into and never continued. Used by one rank.
class CheckpointFolder {
 public:
  explicit CheckpointFolder(const std::filesystem::path& run_folder) : path_(run_folder / "checkpoints") {}

  struct Entry {
    std::int64_t step;
    std::filesystem::path path;
  };

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(std::int64_t step) const;
  std::filesystem::path failed_file(std::int64_t step) const;

  /// What is there to continue from, the newest first.
  std::vector<Entry> list() const;

  /// Makes the folder where it is missing; returns why not, or "".
  std::string create() const;

  /// Leaves the `keep` newest of those up to `step`. A later one is that of a run that was set back; the run will
  /// replace it when it gets there. What a killed run left under construction goes too.
  void remove_old(std::int64_t step, int keep) const;

  /// Whether a file of that name is one that a run puts here, whole or under construction.
  static bool is_ours(std::string file);

 private:
  std::filesystem::path path_;
};

}  // namespace npfem::flow
