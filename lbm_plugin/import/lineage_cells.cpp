// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_cells.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>

#include "file.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

namespace fs = std::filesystem;

/// The numbers of one line between commas. Lines end in LF or CRLF.
std::vector<double> numbers_of(std::string_view line, std::size_t count, const std::string& place) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = line.find(',');
    std::string_view word = line.substr(0, comma);
    while (!word.empty() && (word.front() == ' ' || word.front() == '\t' || word.front() == '+')) word.remove_prefix(1);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t' || word.back() == '\r')) word.remove_suffix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw text::InputError(place + ": found \"" + std::string(word.substr(0, 40)) + "\" where a number is needed");
    }
    numbers.push_back(value);
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  if (numbers.size() != count) {
    throw text::InputError(place + ": found " + std::to_string(numbers.size()) + " numbers; " + std::to_string(count) +
                           " are needed");
  }
  return numbers;
}

template <class Line>  // called with the line and its place, name:line
void for_each_line(std::string_view text, const std::string& name, const Line& line) {
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view content = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    line(content, name + ":" + std::to_string(number));
  }
}

/// The iteration in a name like body_ID_<id>_iT_<digits>.csv; -1 where it is none.
std::int64_t iteration_in(const std::string& name) {
  const std::size_t at = name.find("_iT_");
  if (!name.starts_with("body_ID_") || !name.ends_with(".csv") || at == std::string::npos) return -1;
  std::int64_t value = -1;
  const char* last = name.data() + name.size() - 4;
  const auto [end, error] = std::from_chars(name.data() + at + 4, last, value);
  return error == std::errc() && end == last ? value : -1;
}

}  // namespace

std::vector<LineagePlacing> parse_placings(std::string_view text, const std::string& name) {
  std::vector<LineagePlacing> placings;
  for_each_line(text, name, [&](std::string_view line, const std::string& place) {
    const std::vector<double> n = numbers_of(line, 7, place);
    if (n[0] != 0 && n[0] != 1) {
      throw text::InputError(place + ": the type is " + text::format_number(n[0]) +
                             "; 0 (red cell) or 1 (platelet) is needed");
    }
    placings.push_back({static_cast<int>(n[0]), {n[1], n[2], n[3]}, {n[4], n[5], n[6]}});
  });
  return placings;
}

LineageCheckpoint::LineageCheckpoint(const fs::path& folder, int bodies) : folder_(folder) {
  std::map<std::int64_t, int> complete;  // files by iteration
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::int64_t iteration = iteration_in(entry.path().filename().string());
    if (iteration >= 0) ++complete[iteration];
  }
  for (const auto& [iteration, files] : complete) {
    if (files >= bodies) iteration_ = iteration;
  }
  for (int body = 0; body < bodies; ++body) {
    if (!fs::is_regular_file(file_of(body))) {
      throw text::InputError("\"" + folder.string() + "\" holds no complete set of " + std::to_string(bodies) +
                             " bodies: \"" + file_of(body).filename().string() + "\" is missing");
    }
  }
}

fs::path LineageCheckpoint::file_of(int body) const {
  std::string name = "body_ID_" + std::to_string(body);
  if (iteration_ >= 0) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%012lld", static_cast<long long>(iteration_));
    name += std::string("_iT_") + digits;
  }
  return folder_ / (name + ".csv");
}

std::vector<double> LineageCheckpoint::positions(int body, int vertices) const {
  const std::string path = file_of(body).string();
  std::vector<double> xyz;
  for_each_line(text::read_file(path), path, [&](std::string_view line, const std::string& place) {
    const std::vector<double> n = numbers_of(line, 3, place);
    xyz.insert(xyz.end(), n.begin(), n.end());
  });
  if (xyz.size() != 3 * static_cast<std::size_t>(vertices)) {
    throw text::InputError("\"" + path + "\" holds " + std::to_string(xyz.size() / 3) + " vertices; its body has " +
                           std::to_string(vertices));
  }
  return xyz;
}

}  // namespace npfem::flow
