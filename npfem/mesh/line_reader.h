// SPDX-License-Identifier: MPL-2.0
// A text file line by line, with messages that carry file:line. LF and CRLF are the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace npfem {

class LineReader {
 public:
  /// `comment` starts a comment that runs to the end of the line; 0 = the format has none.
  LineReader(std::string_view content, std::string name, char comment = 0);

  /// The next line; false at the end of the file (one final newline is not a line).
  bool next();
  /// The next line that holds more than blanks and comments.
  bool next_filled();
  /// The next filled line; fails with `what` at the end of the file.
  void require_next(const char* what);

  std::string_view line() const { return line_; }
  int number() const { return number_; }

  /// The parts of the line between blanks, or between separators.
  std::vector<std::string_view> words() const;
  std::vector<std::string_view> fields(char separator) const;

  double to_double(std::string_view word) const;  ///< finite
  double to_single(std::string_view word) const;  ///< rounded to single precision, finite
  int to_int(std::string_view word) const;

  /// Throws Error(bad_input), "name:line: message".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view rest_;
  std::string name_;
  char comment_;
  std::string_view line_;
  int number_ = 0;
};

/// A word of a file for a message: quoted, cut after 40 characters, without control characters.
std::string quoted_word(std::string_view word);

}  // namespace npfem
