// SPDX-License-Identifier: MPL-2.0
#include "walltime.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "quantity.h"

namespace npfem::app {
namespace {

/// Takes a number off the front of the text.
std::optional<double> take_number(std::string_view& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !(value >= 0)) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Seconds in the unit at the front of the text, which is taken off.
std::optional<double> take_unit(std::string_view& text) {
  constexpr std::array<std::pair<std::string_view, double>, 7> units{
      {{"days", 86400}, {"day", 86400}, {"min", 60}, {"d", 86400}, {"h", 3600}, {"m", 60}, {"s", 1}}};
  for (const auto& [name, seconds] : units) {
    if (!text.starts_with(name)) continue;
    text.remove_prefix(name.size());
    return seconds;
  }
  return {};
}

void skip_blanks(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
}

/// "3h30m"
std::optional<double> with_units(std::string_view text) {
  double total = 0;
  do {
    const auto number = take_number(text);
    skip_blanks(text);
    const auto unit = take_unit(text);
    if (!number || !unit) return {};
    total += *number * *unit;
    skip_blanks(text);
  } while (!text.empty());
  return total;
}

/// "d-hh:mm:ss", "hh:mm:ss" or "mm:ss"
std::optional<double> with_colons(std::string_view text) {
  double days = 0;
  if (const std::size_t dash = text.find('-'); dash != std::string_view::npos) {
    std::string_view front = text.substr(0, dash);
    const auto number = take_number(front);
    if (!number || !front.empty()) return {};
    days = *number;
    text.remove_prefix(dash + 1);
  }
  double total = 0;
  for (int fields = 0; fields < 3; ++fields) {
    const auto number = take_number(text);
    if (!number) return {};
    total = 60 * total + *number;
    if (text.empty()) return fields > 0 ? std::optional(86400 * days + total) : std::nullopt;
    if (!text.starts_with(':')) return {};
    text.remove_prefix(1);
  }
  return {};
}

}  // namespace

double parse_walltime(const std::string& text) {
  const bool colons = text.find(':') != std::string::npos;
  const std::optional<double> seconds = colons ? with_colons(text) : with_units(text);
  if (seconds && std::isfinite(*seconds) && *seconds > 0) return *seconds;
  throw text::InputError("--walltime \"" + text +
                         "\": write a time like 3h30m, \"90 min\", 45s, 03:30:00 or 1-12:00:00 (days-hh:mm:ss)");
}

}  // namespace npfem::app
