// SPDX-License-Identifier: MPL-2.0
#include "file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace npfem::text {
namespace {

std::string last_reason() {
  return std::generic_category().message(errno);
}

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw FileError("cannot read \"" + path + "\": no such file");
  if (!std::filesystem::is_regular_file(status)) throw FileError("cannot read \"" + path + "\": not a regular file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError("cannot read \"" + path + "\": " + last_reason());
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw FileError("cannot read \"" + path + "\": " + last_reason());
  return content;
}

void write_file(const std::string& path, std::string_view content) {
  const std::string part = path + ".part";
  std::ofstream stream(part, std::ios::binary | std::ios::trunc);
  if (!stream) throw FileError("cannot write \"" + path + "\": " + last_reason());
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream || std::rename(part.c_str(), path.c_str()) != 0) {
    const std::string reason = last_reason();
    std::remove(part.c_str());
    throw FileError("cannot write \"" + path + "\": " + reason);
  }
}

}  // namespace npfem::text
