// SPDX-License-Identifier: MPL-2.0
// "Did you mean ...": the allowed word nearest to a misspelt one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace npfem::text {

/// Damerau-Levenshtein distance (optimal string alignment): insert, delete, replace, or swap two neighbours, each
/// costs 1.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `words`, or "" when none is near enough to be a likely slip (about a third of the letters).
std::string nearest(std::string_view word, const std::vector<std::string>& words);

/// The end of a message about a word that is not one of `words`: `; did you mean "b"? allowed: a, b, c`.
std::string suggestion(std::string_view word, const std::vector<std::string>& words,
                       std::string_view label = "allowed");

}  // namespace npfem::text
