// SPDX-License-Identifier: MPL-2.0
#pragma once

// A file under construction: `path`.part, which takes the name `path` once it is complete. Used by one rank.
// Functions that can fail return the message ("" on success), to be agreed on by all ranks.

#include <cstdint>
#include <filesystem>
#include <string>

namespace npfem::flow {

std::filesystem::path part_of(const std::filesystem::path& path);
std::string write_failure(const std::filesystem::path& path, const std::string& reason);
std::string create_part(const std::filesystem::path& path);  // empty, replacing one left by a run that died
std::string publish_part(const std::filesystem::path& path, std::int64_t expected_bytes);
void discard_part(const std::filesystem::path& path) noexcept;

}  // namespace npfem::flow
