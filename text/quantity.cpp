// SPDX-License-Identifier: MPL-2.0
#include "quantity.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace npfem::text {
namespace {

/// 10^decimals base units per unit (times `factor`, which only degrees need).
struct Unit {
  std::string_view symbol;
  std::array<int, 4> powers;  ///< length, time, mass, angle
  int decimals;
  double factor = 1;
};

constexpr Unit units[] = {
    {"m", {1, 0, 0, 0}, 6},
    {"s", {0, 1, 0, 0}, 6},
    {"g", {0, 0, 1, 0}, 15},
    {"N", {1, -2, 1, 0}, 12},
    {"Pa", {-1, -2, 1, 0}, 0},
    {"J", {2, -2, 1, 0}, 18},
    {"Hz", {0, -1, 0, 0}, -6},
    {"L", {3, 0, 0, 0}, 15},
    {"rad", {0, 0, 0, 1}, 0},
    {"%", {0, 0, 0, 0}, -2},
    {"deg", {0, 0, 0, 1}, 0, std::numbers::pi / 180},
};

struct Prefix {
  char letter;
  int decimals;
};

constexpr Prefix prefixes[] = {{'f', -15}, {'p', -12}, {'n', -9}, {'u', -6}, {'m', -3},
                               {'c', -2},  {'k', 3},   {'M', 6},  {'G', 9}};

constexpr const char* known_units = "m s g N Pa J Hz L rad deg %, with the prefixes f p n u m c k M G";

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string quoted(std::string_view text) {
  return '"' + std::string(text) + '"';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The micro signs, the middle dot, superscripts and the degree sign in plain ASCII.
std::string in_ascii(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> spellings[] = {
      {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b7", "."}, {"\u00b2", "2"}, {"\u00b3", "3"}, {"\u00b0", "deg"}};
  std::string result;
  while (!text.empty()) {
    std::string_view replaced = text.substr(0, 1), by = replaced;
    for (const auto& [sign, ascii] : spellings) {
      if (text.starts_with(sign)) replaced = sign, by = ascii;
    }
    result += by;
    text.remove_prefix(replaced.size());
  }
  return result;
}

/// The unit of `symbol` ("uN", "Pa"), its prefix included.
Unit find_unit(std::string_view symbol, std::string_view whole) {
  for (const Unit& unit : units) {
    if (unit.symbol == symbol) return unit;
  }
  for (const Prefix& prefix : prefixes) {
    if (symbol.size() < 2 || symbol.front() != prefix.letter) continue;
    for (Unit unit : units) {
      if (unit.symbol != symbol.substr(1) || unit.symbol == "%" || unit.symbol == "deg") continue;
      unit.decimals += prefix.decimals;
      return unit;
    }
  }
  throw InputError("unknown unit " + quoted(symbol) + " in " + quoted(whole) + "; known units: " + known_units);
}

/// Reads a product of units, "uN s/m".
class UnitParser {
 public:
  UnitParser(std::string_view text, std::string_view whole) : rest_(text), whole_(whole) {}

  Unit parse() {
    Unit product{"", {0, 0, 0, 0}, 0};
    bool divided = false;
    for (skip_blanks(); !rest_.empty(); skip_blanks()) {
      const bool divide = take('/');
      if (!divide && divided) fail("a product after '/' could be meant either way; write 1/(a b) as \"1/a/b\"");
      if (!divide && started_ && !take('*')) take('.');
      skip_blanks();
      divided = divided || divide;
      multiply_by_factor(product, divide ? -1 : 1);
      started_ = true;
    }
    return product;
  }

 private:
  void multiply_by_factor(Unit& product, int sign) {
    if (take('1')) return;  // the 1 of "1/s"
    std::size_t length = 0;
    while (length < rest_.size() && is_letter(rest_[length])) ++length;
    if (length == 0) fail(rest_.empty() ? "the unit ends too early" : "a unit is expected at " + quoted(rest_));
    const Unit unit = find_unit(rest_.substr(0, length), whole_);
    rest_.remove_prefix(length);
    const int power = sign * take_power();
    for (std::size_t i = 0; i < 4; ++i) product.powers[i] += power * unit.powers[i];
    product.decimals += power * unit.decimals;
    for (int i = 0; i < std::abs(power); ++i) product.factor *= power > 0 ? unit.factor : 1 / unit.factor;
  }

  /// "3", "^3", "-3" or nothing, which is 1.
  int take_power() {
    const bool marked = take('^');
    const bool negative = take('-');
    if (rest_.empty() || !is_digit(rest_.front())) {
      if (marked || negative) fail("a power is expected at " + quoted(rest_));
      return 1;
    }
    const int power = rest_.front() - '0';
    rest_.remove_prefix(1);
    if (!rest_.empty() && is_digit(rest_.front())) fail("powers of units go to 9");
    return negative ? -power : power;
  }

  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError("cannot read " + quoted(whole_) + ": " + message);
  }

  std::string_view rest_;
  std::string_view whole_;
  bool started_ = false;
};

std::string name_of(const Unit& unit) {
  static constexpr Dimension known[] = {Dimension::none(),
                                        Dimension::angle(),
                                        Dimension::length(),
                                        Dimension::area(),
                                        Dimension::volume(),
                                        Dimension::time(),
                                        Dimension::mass(),
                                        Dimension::velocity(),
                                        Dimension::acceleration(),
                                        Dimension::rate(),
                                        Dimension::flow_rate(),
                                        Dimension::density(),
                                        Dimension::surface_density(),
                                        Dimension::force(),
                                        Dimension::force_density(),
                                        Dimension::energy(),
                                        Dimension::stress(),
                                        Dimension::surface_modulus(),
                                        Dimension::surface_viscosity(),
                                        Dimension::dynamic_viscosity(),
                                        Dimension::kinematic_viscosity()};
  const Dimension found{unit.powers[0], unit.powers[1], unit.powers[2], unit.powers[3], "", ""};
  for (const Dimension& dimension : known) {
    if (dimension.same_as(found)) return dimension.name;
  }
  return "quantity in m^" + std::to_string(unit.powers[0]) + " s^" + std::to_string(unit.powers[1]) + " kg^" +
         std::to_string(unit.powers[2]);
}

std::string with_article(const std::string& noun) {
  return (std::string_view("aeiou").find(noun.front()) == std::string_view::npos ? "a " : "an ") + noun;
}

/// The double nearest to the decimal number `digits` times 10^decimals.
double shifted(std::string_view digits, int decimals, std::string_view whole) {
  const std::size_t e = digits.find_first_of("eE");
  long exponent = 0;
  std::errc status{};
  if (e != std::string_view::npos) {
    const std::size_t first = e + (digits[e + 1] == '+' ? 2 : 1);
    status = std::from_chars(digits.data() + first, digits.data() + digits.size(), exponent).ec;
  }
  double value = 0;
  if (status == std::errc()) {
    const std::string text = std::string(digits.substr(0, e)) + 'e' + std::to_string(exponent + decimals);
    status = std::from_chars(text.data(), text.data() + text.size(), value).ec;
  }
  if (status != std::errc()) throw InputError("the number in " + quoted(whole) + " is too large or too small");
  return value;
}

/// d.ddd 10^exponent, given by its digits without the point, as a person writes it.
std::string decimal_text(const std::string& digits, int exponent) {
  const auto zeros = [](int count) { return std::string(static_cast<std::size_t>(count), '0'); };
  const int count = static_cast<int>(digits.size());
  if (exponent < -5 || exponent > 15) {
    const std::string fraction = count > 1 ? '.' + digits.substr(1) : "";
    return digits.substr(0, 1) + fraction + 'e' + std::to_string(exponent);
  }
  if (exponent < 0) return "0." + zeros(-exponent - 1) + digits;
  if (exponent + 1 >= count) return digits + zeros(exponent + 1 - count);
  const auto point = static_cast<std::size_t>(exponent + 1);
  return digits.substr(0, point) + '.' + digits.substr(point);
}

std::string shortest_decimal(double value, int decimals) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  if (value == 0) return std::signbit(value) ? "-0" : "0";
  std::array<char, 64> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value), std::chars_format::scientific).ptr;
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  const std::size_t e = text.find('e');
  std::string digits(text.substr(0, e));
  if (digits.size() > 1) digits.erase(1, 1);
  int exponent = 0;
  std::from_chars(text.data() + e + (text[e + 1] == '+' ? 2 : 1), end, exponent);
  const std::string magnitude = decimal_text(digits, exponent + decimals);
  return value < 0 ? '-' + magnitude : magnitude;
}

}  // namespace

bool Dimension::same_as(const Dimension& other) const {
  return length_power == other.length_power && time_power == other.time_power && mass_power == other.mass_power &&
         angle_power == other.angle_power;
}

std::string describe(const Dimension& dimension) {
  if (dimension.is_none()) return "a number without unit, like 0.5";
  return with_article(dimension.name) + ", like \"1 " + dimension.unit + '"';
}

double parse_quantity(std::string_view text, const Dimension& dimension) {
  const std::string ascii = in_ascii(trimmed(text));
  std::string_view rest = ascii;
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
  double bare = 0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), bare);
  if (status == std::errc::invalid_argument) {
    throw InputError("found " + quoted(text) + ", but " + describe(dimension) + " is needed");
  }
  if (status != std::errc()) throw InputError("the number in " + quoted(text) + " is too large or too small");
  if (!std::isfinite(bare)) throw InputError("found " + quoted(text) + ", but a finite number is needed");

  const std::size_t length = static_cast<std::size_t>(end - rest.data());
  const std::string_view unit_text = trimmed(rest.substr(length));
  const Unit unit = UnitParser(unit_text, text).parse();
  const Dimension found{unit.powers[0], unit.powers[1], unit.powers[2], unit.powers[3], "", ""};
  if (!found.same_as(dimension)) {
    const std::string what = unit_text.empty() ? "has no unit" : "is " + with_article(name_of(unit));
    throw InputError(quoted(text) + ' ' + what + ", but " + describe(dimension) + " is needed");
  }
  return shifted(rest.substr(0, length), unit.decimals, text) * unit.factor;
}

std::string format_quantity(double value, std::string_view unit_text) {
  const std::string ascii = in_ascii(unit_text);
  const Unit unit = UnitParser(ascii, unit_text).parse();
  const double in_decimal_unit = unit.factor == 1 ? value : value / unit.factor;
  const std::string number = shortest_decimal(in_decimal_unit, -unit.decimals);
  return unit_text.empty() || unit_text == "1" ? number : number + ' ' + std::string(unit_text);
}

std::string format_rounded(double value) {
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 3).ptr;
  return {digits.data(), end};
}

std::string format_number(double value) {
  return shortest_decimal(value, 0);
}

}  // namespace npfem::text
