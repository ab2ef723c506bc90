// SPDX-License-Identifier: MPL-2.0
#include "communicator/part_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace npfem::flow {

std::filesystem::path part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += ".part";
  return part;
}

std::string write_failure(const std::filesystem::path& path, const std::string& reason) {
  return "cannot write " + path.string() + ": " + reason;
}

std::string create_part(const std::filesystem::path& path) {
  std::FILE* file = std::fopen(part_of(path).c_str(), "wb");
  if (file == nullptr) return write_failure(path, std::generic_category().message(errno));
  std::fclose(file);
  return {};
}

std::string publish_part(const std::filesystem::path& path, std::int64_t expected_bytes) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(part_of(path), error);
  if (!error && static_cast<std::int64_t>(bytes) != expected_bytes) {
    discard_part(path);
    return write_failure(
        path, std::to_string(bytes) + " of " + std::to_string(expected_bytes) + " bytes reached the disk; is it full?");
  }
  if (!error) std::filesystem::rename(part_of(path), path, error);
  if (!error) return {};
  discard_part(path);
  return write_failure(path, error.message());
}

void discard_part(const std::filesystem::path& path) noexcept {
  std::error_code ignored;
  std::filesystem::remove(part_of(path), ignored);
}

}  // namespace npfem::flow
