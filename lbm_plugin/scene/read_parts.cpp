// SPDX-License-Identifier: MPL-2.0
#include "scene/read_parts.h"

#include <cmath>

namespace npfem::flow {

using text::Key;
using text::Table;

const Key* one_of(const Table& table, std::initializer_list<const Key*> keys) {
  const Key* found = nullptr;
  for (const Key* key : keys) {
    if (!table.has(*key)) continue;
    if (found) table.fail(key->name, std::string("\"") + found->name + "\" is given too; give only one of them");
    found = key;
  }
  return found;
}

const Key& exactly_one_of(const Table& table, std::initializer_list<const Key*> keys) {
  if (const Key* found = one_of(table, keys)) return *found;
  std::string names;
  for (const Key* key : keys) names += (names.empty() ? "\"" : "\" or \"") + std::string(key->name);
  table.fail("one of " + names + "\" is needed");
}

void refuse(const Table& table, std::initializer_list<const Key*> keys, const std::string& reason) {
  for (const Key* key : keys) {
    if (table.has(*key)) table.fail(key->name, reason);
  }
}

int within(const Table& table, const Key& key, int least, int largest) {
  const std::int64_t value = table.integer(key);
  if (value < least || value > largest) {
    table.fail(key.name,
               std::to_string(value) + " is not allowed: " + std::to_string(least) + " to " + std::to_string(largest));
  }
  return static_cast<int>(value);
}

std::string path_from(const std::string& path, const std::filesystem::path& folder) {
  const std::filesystem::path given(path);
  return given.is_absolute() ? path : (folder / given).lexically_normal().string();
}

double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
}

}  // namespace npfem::flow
