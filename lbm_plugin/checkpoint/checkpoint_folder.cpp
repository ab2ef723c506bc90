// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/checkpoint_folder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string_view>
#include <system_error>

namespace npfem::flow {
namespace {

constexpr std::string_view whole = "checkpoint_", failed = "failed_", ending = ".npfem", part = ".part";

std::string numbered(std::string_view name, std::int64_t step) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%012lld", static_cast<long long>(step));
  return std::string(name) + digits.data() + std::string(ending);
}

/// The number in "<name><digits>.npfem".
std::optional<std::int64_t> step_in(std::string_view file, std::string_view name) {
  if (!file.starts_with(name) || !file.ends_with(ending)) return {};
  const char* begin = file.data() + name.size();
  const char* end = file.data() + file.size() - ending.size();
  std::int64_t step = 0;
  const auto [rest, error] = std::from_chars(begin, std::max(begin, end), step);
  return error == std::errc() && rest == end && step >= 0 ? std::optional(step) : std::nullopt;
}

}  // namespace

std::filesystem::path CheckpointFolder::file(std::int64_t step) const {
  return path_ / numbered(whole, step);
}

std::filesystem::path CheckpointFolder::failed_file(std::int64_t step) const {
  return path_ / numbered(failed, step);
}

std::vector<CheckpointFolder::Entry> CheckpointFolder::list() const {
  std::vector<Entry> entries;
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(path_, error)) {
    if (const auto step = step_in(file.path().filename().string(), whole)) entries.push_back({*step, file.path()});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.step > b.step; });
  return entries;
}

std::string CheckpointFolder::create() const {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  return error ? "cannot create the folder " + path_.string() + ": " + error.message() : "";
}

void CheckpointFolder::remove_old(std::int64_t step, int keep) const {
  for (const Entry& entry : list()) {
    if (entry.step > step || keep-- > 0) continue;
    std::error_code ignored;
    std::filesystem::remove(entry.path, ignored);
  }
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(path_, error)) {
    const std::string name = file.path().filename().string();
    if (name.ends_with(part) && is_ours(name)) std::filesystem::remove(file.path(), error);
  }
}

bool CheckpointFolder::is_ours(std::string file) {
  if (file.ends_with(part)) file.resize(file.size() - part.size());
  return step_in(file, whole) || step_in(file, failed);
}

}  // namespace npfem::flow
