// SPDX-License-Identifier: MPL-2.0
#include "communicator/part_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace npfem::flow {
namespace {

// Returns errno, 0 once the disk has the file or the entries of the folder. A file system that cannot sync a folder
// (EINVAL) is let pass.
int wait_for_disk(const std::filesystem::path& path, int kind) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | kind);
  if (descriptor < 0) return errno;
  const int failure = fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  close(descriptor);
  return failure;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

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

std::string publish_part(const std::filesystem::path& path, std::int64_t expected_bytes, bool durable) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(part_of(path), error);
  if (!error && static_cast<std::int64_t>(bytes) != expected_bytes) {
    discard_part(path);
    return write_failure(
        path, std::to_string(bytes) + " of " + std::to_string(expected_bytes) + " bytes reached the disk; is it full?");
  }
  if (!error && durable) error.assign(wait_for_disk(part_of(path), 0), std::generic_category());
  if (!error) std::filesystem::rename(part_of(path), path, error);
  if (error) {
    discard_part(path);
    return write_failure(path, error.message());
  }
  if (const int failure = durable ? wait_for_disk(folder_of(path), O_DIRECTORY) : 0; failure != 0) {
    return write_failure(path, std::generic_category().message(failure));
  }
  return {};
}

void discard_part(const std::filesystem::path& path) noexcept {
  std::error_code ignored;
  std::filesystem::remove(part_of(path), ignored);
}

std::int64_t end_of(std::span<const Chunk> chunks) {
  std::int64_t end = 0;
  for (const Chunk& chunk : chunks) {
    if (!chunk.bytes.empty()) end = std::max(end, chunk.offset + std::ssize(chunk.bytes));
  }
  return end;
}

}  // namespace npfem::flow
