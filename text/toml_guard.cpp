// SPDX-License-Identifier: MPL-2.0
#include "toml_guard.h"

#include <algorithm>

#include "quantity.h"

namespace npfem::text {
namespace {

constexpr int most_dots = 200;

/// The length of the string that starts `text` with `quote`, its quotes included, or the rest where it does not end.
std::size_t string_length(std::string_view text, char quote) {
  const std::string triple(3, quote);
  const bool is_multiline = text.starts_with(triple);
  const std::string_view end = is_multiline ? std::string_view(triple) : std::string_view(triple).substr(0, 1);
  for (std::size_t i = end.size(); i < text.size(); ++i) {
    if (text.substr(i).starts_with(end)) return i + end.size();
    if (!is_multiline && text[i] == '\n') return i;
    if (quote == '"' && text[i] == '\\') ++i;
  }
  return text.size();
}

/// A backslash before white space, by which TOML joins lines: toml++ then trips over what follows if it is not ASCII.
bool continues_a_line(std::string_view string) {
  for (std::size_t i = string.find('\\'); i + 1 < string.size(); i = string.find('\\', i + 1)) {
    if (std::string_view(" \t\r\n").find(string[i + 1]) != std::string_view::npos) return string.starts_with('"');
  }
  return false;
}

}  // namespace

void require_plain_toml(std::string_view text, const std::string& name) {
  int line = 1, dots = 0;
  const auto fail = [&](const std::string& message) {
    throw InputError(name + ':' + std::to_string(line) + ":1: " + message);
  };
  std::size_t length = 1;
  for (; !text.empty(); text.remove_prefix(length)) {
    const char c = text.front();
    length = 1;
    if (c == '#') {
      length = std::min(text.find('\n'), text.size());
    } else if (c == '"' || c == '\'') {
      length = string_length(text, c);
      const std::string_view string = text.substr(0, length);
      if (continues_a_line(string)) fail("a line of a string ends in a backslash; write the string on one line");
      line += static_cast<int>(std::count(string.begin(), string.end(), '\n'));
    } else if (c == '\n') {
      ++line;
      dots = 0;
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      fail("a character that is not ASCII stands outside quotes; put the value in quotes");
    } else if (c == '.' && ++dots > most_dots) {
      fail("more than " + std::to_string(most_dots) + " dots in one line; break it into several");
    }
  }
}

}  // namespace npfem::text
