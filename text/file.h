// SPDX-License-Identifier: MPL-2.0
// Whole files in and out.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace npfem::text {

/// A file that cannot be read or written; the message names it and says why.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a regular file.
std::string read_file(const std::string& path);

/// Writes beside `path` and renames, so that `path` is either the old file or the whole new one.
void write_file(const std::string& path, std::string_view content);

}  // namespace npfem::text
