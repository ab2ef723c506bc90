// SPDX-License-Identifier: MPL-2.0
#pragma once

// A file under construction: `path`.part, which takes the name `path` once it is complete. Used by one rank.
// Functions that can fail return the message ("" on success), to be agreed on by all ranks.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "communicator/communicator.h"

namespace npfem::flow {

std::filesystem::path part_of(const std::filesystem::path& path);
std::string write_failure(const std::filesystem::path& path, const std::string& reason);
std::string create_part(const std::filesystem::path& path);  // empty, replacing one left by a run that died
// `durable`: waits for the disk, the file first and then its name.
std::string publish_part(const std::filesystem::path& path, std::int64_t expected_bytes, bool durable);
void discard_part(const std::filesystem::path& path) noexcept;

// Where the last of these chunks ends; 0 without chunks.
std::int64_t end_of(std::span<const Chunk> chunks);

}  // namespace npfem::flow
