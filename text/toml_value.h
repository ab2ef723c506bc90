// SPDX-License-Identifier: MPL-2.0
// One node of a TOML document with its place in the file: what Document and Table work on.
#pragma once

#include <cstdint>
#include <list>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace npfem::text {

struct Field;

struct Value {
  using Array = std::vector<Value>;
  using Fields = std::list<Field>;  ///< in the order of the file; adding one leaves the others where they are

  std::variant<std::string, std::int64_t, double, bool, Array, Fields> data;
  int line = 0, column = 0;     ///< 0 = not in the file
  std::string origin;           ///< "--set run.steps=100" for an override, else empty
  std::set<std::string> known;  ///< of a table: the names that somebody asked for

  bool is_table() const { return std::holds_alternative<Fields>(data); }
  bool is_array() const { return std::holds_alternative<Array>(data); }
  Fields& fields() { return std::get<Fields>(data); }
  const Fields& fields() const { return std::get<Fields>(data); }
  Value* find(std::string_view name);
  Value& add(std::string name, Value value);
};

struct Field {
  std::string name;
  Value value;
  int line = 0, column = 0;  ///< of the name
};

/// A whole document; throws InputError with name:line:column.
Value parse_toml(std::string_view text, const std::string& name);

/// One value as a person writes it on a command line: TOML, or a string when it is not TOML.
Value parse_loose(std::string_view text);

/// A table as a TOML document.
std::string print_toml(const Value& table);

/// A value for a message: "abc", 0.5, true, a list, a table.
std::string describe_value(const Value& value);

}  // namespace npfem::text
