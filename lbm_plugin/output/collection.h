// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace npfem::flow {

/// A ParaView collection (.pvd): the files of a run and their times. Replaced whole after each step, so that it can be
/// opened while the run goes on. Used by one rank.
class Collection {
 public:
  explicit Collection(std::filesystem::path path) : path_(std::move(path)) {}

  /// Takes up the entries of the collection that is there whose files are numbered up to `step`, as far as they exist;
  /// later ones leave the list, and their files go. Returns whether one of them is of that very step.
  /// text::FileError where the list cannot be written.
  bool resume(std::int64_t step);

  /// Adds a file beside the collection and writes the collection. text::FileError where it cannot.
  void add(double time_us, const std::string& file);

 private:
  struct Entry {
    std::string time_us;
    std::string file;
  };
  void write() const;

  std::filesystem::path path_;
  std::vector<Entry> entries_;
};

}  // namespace npfem::flow
