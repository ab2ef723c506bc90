// SPDX-License-Identifier: MPL-2.0
// What must hold before a text is given to the TOML parser, so that no text can hurt it.
#pragma once

#include <string>
#include <string_view>

namespace npfem::text {

/// Throws InputError with name:line unless, outside strings and comments, the text is ASCII (TOML allows nothing else
/// there, and toml++ 3.3 runs into undefined behaviour on it), no string continues a line by a backslash (likewise) and
/// no line has more than 200 dots: each dot of a key nests one table more, and a document some ten thousand tables deep
/// exhausts the stack of whoever walks it.
void require_plain_toml(std::string_view text, const std::string& name);

}  // namespace npfem::text
