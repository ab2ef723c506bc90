// SPDX-License-Identifier: MPL-2.0
// The description of one key of a TOML file. The reader fetches a value through its Key, and the reference page is
// printed from the same Key, so that what is documented and what is accepted cannot differ.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "quantity.h"

namespace npfem::text {

enum class Kind {
  quantity,    ///< a number with a unit; a plain number where the dimension is none
  quantities,  ///< a list of them
  vector3,     ///< exactly three of them
  integer,
  boolean,
  text,
  choice,  ///< one word of `choices`
};

enum class Range { any, positive, non_negative, fraction };  ///< fraction: 0 to 1, both included

inline constexpr const char* required = "";  ///< as a fallback: the key must be given
inline constexpr const char* optional =
    "(none)";  ///< as a fallback: may be left out, without a default; ask has() first

struct Key {
  const char* name;
  Kind kind = Kind::quantity;
  Dimension dimension = Dimension::none();
  Range range = Range::any;         ///< holds for every number of the value
  const char* choices = "";         ///< words between blanks: "shear tube plates"
  const char* fallback = required;  ///< what a user would write: "0.5 um", "20 %", "4", "true", "[0, 0, 0]", "shear"
  const char* doc = "";             ///< one sentence for the reference page
};

/// The words of Key::choices, one by one.
std::vector<std::string> words_of(const char* choices);

/// A Markdown table of the keys: key, value, default, meaning.
std::string markdown_table(std::span<const Key> keys);

}  // namespace npfem::text
