// SPDX-License-Identifier: MPL-2.0
#include "key.h"

#include <sstream>
#include <string_view>

namespace npfem::text {
namespace {

std::string value_cell(const Key& key) {
  const std::string number = key.dimension.is_none() ? "number" : std::string(key.dimension.name);
  switch (key.kind) {
    case Kind::quantity:
      return key.dimension.is_none() ? number : number + " (`" + key.dimension.unit + "`)";
    case Kind::quantities:
      return "list of " + number + " (`" + key.dimension.unit + "`)";
    case Kind::vector3:
      return "three times " + number + " (`" + key.dimension.unit + "`)";
    case Kind::integer:
      return "integer";
    case Kind::boolean:
      return "`true` or `false`";
    case Kind::text:
      return "text";
    case Kind::choice:
      break;
  }
  std::string words;
  for (const std::string& word : words_of(key.choices)) words += (words.empty() ? "`" : ", `") + word + '`';
  return words;
}

std::string range_words(Range range) {
  switch (range) {
    case Range::positive:
      return ", > 0";
    case Range::non_negative:
      return ", >= 0";
    case Range::fraction:
      return ", 0 to 1";
    case Range::any:
      break;
  }
  return "";
}

std::string default_cell(const Key& key) {
  const std::string_view fallback = key.fallback;
  if (fallback == required) return "required";
  return fallback == optional ? "none" : '`' + std::string(fallback) + '`';
}

}  // namespace

std::vector<std::string> words_of(const char* choices) {
  std::vector<std::string> words;
  std::istringstream stream{std::string(choices)};
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string markdown_table(std::span<const Key> keys) {
  std::string table = "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const Key& key : keys) {
    table += "| `" + std::string(key.name) + "` | " + value_cell(key) + range_words(key.range) + " | " +
             default_cell(key) + " | " + key.doc + " |\n";
  }
  return table;
}

}  // namespace npfem::text
