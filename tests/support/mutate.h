// SPDX-License-Identifier: MPL-2.0
// Damaged input for parsers: a valid text with a few random edits, from a seed.
#pragma once

#include <random>
#include <string>

namespace npfem_test {

/// `text` with 1 to 4 edits: a byte changed, a piece cut, a piece doubled, a telling fragment put in, or the end cut
/// off.
inline std::string mutated(std::string text, std::mt19937& random) {
  static const char* const fragments[] = {"nan", "inf", "-1", "0",  "1e999", "99999999999", "\"", "[", "]",  "{", "=",
                                          ",",   ".",   "\n", "\r", "#",     "\xff",        "\\", "/", "^9", " "};
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = below(text.size() + 1), length = below(12);
    switch (below(5)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(at, fragments[below(std::size(fragments))]);
        break;
      default:
        if (below(4) == 0) text.resize(at);
    }
  }
  return text;
}

}  // namespace npfem_test
