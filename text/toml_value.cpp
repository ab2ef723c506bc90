// SPDX-License-Identifier: MPL-2.0
#include "toml_value.h"

// toml++ asserts (in release builds even assumes) what its own checks then report as an error, on a file like "[[[[".
// A file must not end the program, so the assertions are off in every build and the checks do their work.
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "quantity.h"
#include "toml_guard.h"
#include "toml_reader.h"

namespace npfem::text {
namespace {

std::string place(const std::string& name, const toml::source_position& at) {
  return name + ':' + std::to_string(at.line) + ':' + std::to_string(at.column) + ": ";
}

bool is_before(const Field& a, const Field& b) {
  return a.line != b.line ? a.line < b.line : a.column < b.column;
}

Value convert(const toml::node& node, const std::string& name) {
  const toml::source_position at = node.source().begin;
  Value value;
  value.line = static_cast<int>(at.line);
  value.column = static_cast<int>(at.column);
  if (const auto* table = node.as_table()) {
    Value::Fields fields;
    for (const auto& [key, child] : *table) {
      const toml::source_position key_at = key.source().begin;
      fields.push_back({std::string(key.str()), convert(child, name), static_cast<int>(key_at.line),
                        static_cast<int>(key_at.column)});
    }
    fields.sort(is_before);
    value.data = std::move(fields);
  } else if (const auto* array = node.as_array()) {
    Value::Array items;
    for (const toml::node& child : *array) items.push_back(convert(child, name));
    value.data = std::move(items);
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.data = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.data = boolean->get();
  } else {
    throw InputError(place(name, at) + "dates and times mean nothing here; put text in quotes");
  }
  return value;
}

std::string key_text(const std::string& name) {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? name : toml_string(name);
}

std::string inline_text(const Value& value);

std::string join(const Value::Array& items) {
  std::string text = "[";
  for (const Value& item : items) text += (text.size() > 1 ? ", " : "") + inline_text(item);
  return text + ']';
}

std::string join(const Value::Fields& fields) {
  std::string text = "{";
  for (const Field& field : fields) {
    text += (text.size() > 1 ? ", " : " ") + key_text(field.name) + " = " + inline_text(field.value);
  }
  return text + (text.size() > 1 ? " }" : "}");
}

std::string inline_text(const Value& value) {
  struct Printer {
    std::string operator()(const std::string& text) const { return toml_string(text); }
    std::string operator()(std::int64_t integer) const { return std::to_string(integer); }
    std::string operator()(bool boolean) const { return boolean ? "true" : "false"; }
    std::string operator()(const Value::Array& items) const { return join(items); }
    std::string operator()(const Value::Fields& fields) const { return join(fields); }
    std::string operator()(double number) const {
      const std::string text = format_number(number);
      const bool is_marked = text.find_first_of(".en") != std::string::npos;  // the n of nan and inf
      return is_marked ? text : text + ".0";
    }
  };
  return std::visit(Printer{}, value.data);
}

bool is_array_of_tables(const Value& value) {
  if (!value.is_array()) return false;
  const auto& items = std::get<Value::Array>(value.data);
  return !items.empty() && std::all_of(items.begin(), items.end(), [](const Value& item) { return item.is_table(); });
}

/// The plain values of a table first, then its sub-tables under their headers.
void print_table(const Value& table, const std::string& path, std::string& out) {
  for (const auto& [name, value, line, column] : table.fields()) {
    if (!value.is_table() && !is_array_of_tables(value)) out += key_text(name) + " = " + inline_text(value) + '\n';
  }
  for (const auto& [name, value, line, column] : table.fields()) {
    const std::string child = path.empty() ? key_text(name) : path + '.' + key_text(name);
    if (value.is_table()) {
      out += (out.empty() ? "[" : "\n[") + child + "]\n";
      print_table(value, child, out);
    } else if (is_array_of_tables(value)) {
      for (const Value& item : std::get<Value::Array>(value.data)) {
        out += (out.empty() ? "[[" : "\n[[") + child + "]]\n";
        print_table(item, child, out);
      }
    }
  }
}

}  // namespace

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (code < 0x20 || code == 0x7f) {
      constexpr const char* hex = "0123456789ABCDEF";
      result += {'\\', 'u', '0', '0', hex[code >> 4], hex[code & 15]};
    } else {
      result += c;
    }
  }
  return result + '"';
}

Value* Value::find(std::string_view name) {
  for (Field& field : fields()) {
    if (field.name == name) return &field.value;
  }
  return nullptr;
}

Value& Value::add(std::string name, Value value) {
  return fields().emplace_back(Field{std::move(name), std::move(value), 0, 0}).value;
}

Value parse_toml(std::string_view text, const std::string& name) {
  require_plain_toml(text, name);
  try {
    return convert(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    throw InputError(place(name, error.source().begin) + std::string(error.description()));
  }
}

Value parse_loose(std::string_view text) {
  try {
    Value document = parse_toml("value = " + std::string(text), "value");
    if (document.fields().size() == 1) return std::move(document.fields().front().value);
  } catch (const InputError&) {
    // Not TOML: a string without its quotes.
  }
  Value value;
  value.data = std::string(text);
  return value;
}

std::string print_toml(const Value& table) {
  std::string out;
  print_table(table, "", out);
  return out;
}

std::string describe_value(const Value& value) {
  if (value.is_table()) return "a table";
  if (value.is_array()) return "a list";
  return inline_text(value);
}

}  // namespace npfem::text
