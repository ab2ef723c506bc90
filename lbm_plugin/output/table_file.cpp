// SPDX-License-Identifier: MPL-2.0
#include "output/table_file.h"

#include <cerrno>
#include <charconv>
#include <cstring>

#include "file.h"

namespace npfem::flow {
namespace {

struct Kept {
  std::string text;
  std::int64_t last_step = -1;
};

/// The header and the whole lines up to `step`. A file with other columns, of another version of the program, is not
/// continued.
Kept kept_lines(const std::filesystem::path& path, const std::string& header, std::int64_t step) {
  std::ifstream file(path);
  Kept kept{header};
  std::string line;
  if (!std::getline(file, line) || line + '\n' != header) return kept;
  while (std::getline(file, line) && !file.eof()) {  // the last line of a killed run may have no end
    std::int64_t its_step = -1;
    const auto result = std::from_chars(line.data(), line.data() + line.size(), its_step);
    if (result.ec != std::errc() || its_step > step) continue;
    kept.text += line + '\n';
    kept.last_step = its_step;
  }
  return kept;
}

}  // namespace

TableFile::TableFile(Communicator& communicator, std::filesystem::path path, const std::string& header,
                     std::optional<std::int64_t> resumed_at)
    : communicator_(communicator), path_(std::move(path)) {
  std::string failure;
  if (communicator_.rank() == 0) {
    const Kept kept = resumed_at ? kept_lines(path_, header, *resumed_at) : Kept{header};
    last_step_ = kept.last_step;
    try {
      text::write_file(path_.string(), kept.text);
    } catch (const text::FileError& error) {
      failure = error.what();
    }
    file_.open(path_, std::ios::app);
  }
  communicator_.agree(failure);
  communicator_.maximum(std::span(&last_step_, 1));
  append("");
}

void TableFile::append(const std::string& lines) {
  std::string failure;
  if (communicator_.rank() == 0) {
    errno = 0;
    file_ << lines << std::flush;
    if (!file_) failure = "cannot write " + path_.string() + (errno ? std::string(": ") + std::strerror(errno) : "");
  }
  communicator_.agree(failure);
}

}  // namespace npfem::flow
