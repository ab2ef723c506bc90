// SPDX-License-Identifier: MPL-2.0
#include "mesh/line_reader.h"

#include <charconv>
#include <cmath>

#include "error.h"

namespace npfem {
namespace {

constexpr std::string_view blanks = " \t";

/// The whole word as a number; false when it is anything else (or too large for the type).
template <class T>
bool parse_whole(std::string_view word, T& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  return status == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string quoted_word(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, longest)) text += c >= 0x20 && c < 0x7f ? c : '?';
  return text + (word.size() > longest ? "...\"" : "\"");
}

LineReader::LineReader(std::string_view content, std::string name, char comment)
    : rest_(content), name_(std::move(name)), comment_(comment) {}

bool LineReader::next() {
  if (rest_.empty()) return false;
  ++number_;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  if (comment_ != 0) line_ = line_.substr(0, line_.find(comment_));
  return true;
}

bool LineReader::next_filled() {
  while (next()) {
    if (line_.find_first_not_of(blanks) != std::string_view::npos) return true;
  }
  return false;
}

void LineReader::require_next(const char* what) {
  if (!next_filled()) fail(std::string("the file ends where ") + what + " should follow");
}

std::vector<std::string_view> LineReader::words() const {
  std::vector<std::string_view> words;
  for (std::size_t start = line_.find_first_not_of(blanks); start != std::string_view::npos;) {
    const std::size_t end = line_.find_first_of(blanks, start);
    words.push_back(line_.substr(start, end == std::string_view::npos ? end : end - start));
    start = line_.find_first_not_of(blanks, end);
  }
  return words;
}

std::vector<std::string_view> LineReader::fields(char separator) const {
  std::vector<std::string_view> fields;
  std::size_t start = 0;
  for (std::size_t end = line_.find(separator); end != std::string_view::npos; end = line_.find(separator, start)) {
    fields.push_back(line_.substr(start, end - start));
    start = end + 1;
  }
  fields.push_back(line_.substr(start));
  for (std::string_view& field : fields) {
    while (!field.empty() && blanks.find(field.front()) != std::string_view::npos) field.remove_prefix(1);
    while (!field.empty() && blanks.find(field.back()) != std::string_view::npos) field.remove_suffix(1);
  }
  return fields;
}

double LineReader::to_double(std::string_view word) const {
  double value = 0;
  if (!parse_whole(word, value)) fail("found " + quoted_word(word) + ", but a number is needed");
  if (!std::isfinite(value)) fail("found " + quoted_word(word) + ", but a finite number is needed");
  return value;
}

double LineReader::to_single(std::string_view word) const {
  float value = 0;
  if (!parse_whole(word, value)) fail("found " + quoted_word(word) + ", but a number is needed");
  if (!std::isfinite(value)) fail("found " + quoted_word(word) + ", but a finite number is needed");
  return static_cast<double>(value);
}

int LineReader::to_int(std::string_view word) const {
  int value = 0;
  if (!parse_whole(word, value)) fail("found " + quoted_word(word) + ", but an integer is needed");
  return value;
}

void LineReader::fail(const std::string& message) const {
  throw Error(Status::bad_input, name_ + ':' + std::to_string(number_) + ": " + message);
}

}  // namespace npfem
