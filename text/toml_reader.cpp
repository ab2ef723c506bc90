// SPDX-License-Identifier: MPL-2.0
#include "toml_reader.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "nearest.h"
#include "toml_value.h"

namespace npfem::text {
namespace {

std::string location(const std::string& file, const std::string& origin, int line, int column) {
  if (!origin.empty()) return origin + ": ";
  if (line == 0) return file + ": ";
  return file + ':' + std::to_string(line) + ':' + std::to_string(column) + ": ";
}

std::string join_path(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + '.' + std::string(name);
}

std::string indexed(const std::string& path, std::size_t index) {
  return path + '[' + std::to_string(index) + ']';
}

/// What a Key asks for, in words.
std::string needed(const Key& key) {
  switch (key.kind) {
    case Kind::quantity:
      return describe(key.dimension);
    case Kind::quantities:
      return "a list, each item " + describe(key.dimension);
    case Kind::vector3:
      return "a list of three, each " + describe(key.dimension);
    case Kind::integer:
      return "an integer";
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "text in quotes";
    case Kind::choice:
      break;
  }
  std::string words;
  for (const std::string& word : words_of(key.choices)) words += (words.empty() ? "\"" : ", \"") + word + '"';
  return "one of " + words;
}

const char* broken_rule(Range range, double value) {
  if (range == Range::positive && !(value > 0)) return "must be greater than 0";
  if (range == Range::non_negative && !(value >= 0)) return "must not be negative";
  if (range == Range::fraction && !(value >= 0 && value <= 1)) return "must lie between 0 and 1";
  return nullptr;
}

void require_kind(const Key& key, Kind kind) {
  if (key.kind != kind) throw std::logic_error(std::string("key ") + key.name + " is read as another kind");
}

/// The first key below `table` that nobody asked for.
void require_all_known(const Value& table, const std::string& file, const std::string& path) {
  for (const Field& field : table.fields()) {
    const std::string child = join_path(path, field.name);
    if (!table.known.contains(field.name)) {
      const std::vector<std::string> known(table.known.begin(), table.known.end());
      const std::string place = path.empty() ? "at the top level" : "in [" + path + ']';
      throw InputError(location(file, field.value.origin, field.line, field.column) + "unknown key \"" + field.name +
                       "\" " + place + suggestion(field.name, known, "known keys"));
    }
    if (field.value.is_table()) require_all_known(field.value, file, child);
    if (!field.value.is_array()) continue;
    const auto& items = std::get<Value::Array>(field.value.data);
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (items[i].is_table()) require_all_known(items[i], file, indexed(child, i));
    }
  }
}

}  // namespace

Table::Table(Value* node, const std::string* file, std::string path)
    : node_(node), file_(file), path_(std::move(path)) {}

std::string Table::where(const Value& value) const {
  return location(*file_, value.origin, value.line, value.column);
}

std::string Table::path_of(std::string_view name) const {
  return join_path(path_, name);
}

Value* Table::find(std::string_view name) const {
  node_->known.emplace(name);
  return node_->find(name);
}

bool Table::has(std::string_view name) const {
  return find(name) != nullptr;
}

Value& Table::fetch(const Key& key) const {
  if (Value* value = find(key.name)) return *value;
  const std::string_view fallback = key.fallback;
  if (fallback == required || fallback == optional) {
    throw InputError(where(*node_) + "missing key \"" + path_of(key.name) + "\": " + needed(key) + " is needed");
  }
  return node_->add(key.name, parse_loose(fallback));
}

void Table::fail(std::string_view name, const std::string& message) const {
  throw InputError(located(name, message));
}

std::string Table::located(std::string_view name, const std::string& message) const {
  const Value* value = node_->find(name);
  return where(value ? *value : *node_) + path_of(name) + ": " + message;
}

void Table::fail(const std::string& message) const {
  throw InputError(where(*node_) + (path_.empty() ? "" : path_ + ": ") + message);
}

double Table::number_in(const Key& key, const Value& value) const {
  const std::string start = where(value) + path_of(key.name) + ": ";
  double number = 0;
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    try {
      number = parse_quantity(*text, key.dimension);
    } catch (const InputError& error) {
      throw InputError(start + error.what());
    }
  } else {
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    const auto* floating = std::get_if<double>(&value.data);
    if (!integer && !floating) {
      throw InputError(start + "found " + describe_value(value) + ", but " + describe(key.dimension) + " is needed");
    }
    if (!key.dimension.is_none()) {
      throw InputError(start + describe_value(value) + " has no unit; " + describe(key.dimension) + " is needed");
    }
    number = integer ? static_cast<double>(*integer) : *floating;
  }
  if (!std::isfinite(number)) throw InputError(start + describe_value(value) + " is not a finite number");
  if (const char* rule = broken_rule(key.range, number)) {
    throw InputError(start + describe_value(value) + ' ' + rule);
  }
  return number;
}

double Table::quantity(const Key& key) const {
  require_kind(key, Kind::quantity);
  return number_in(key, fetch(key));
}

std::vector<double> Table::quantities(const Key& key) const {
  if (key.kind != Kind::vector3) require_kind(key, Kind::quantities);
  const Value& value = fetch(key);
  if (!value.is_array()) fail(key.name, "found " + describe_value(value) + ", but " + needed(key) + " is needed");
  std::vector<double> numbers;
  for (const Value& item : std::get<Value::Array>(value.data)) numbers.push_back(number_in(key, item));
  return numbers;
}

std::array<double, 3> Table::vector3(const Key& key) const {
  require_kind(key, Kind::vector3);
  const std::vector<double> numbers = quantities(key);
  if (numbers.size() != 3) {
    fail(key.name, "found " + std::to_string(numbers.size()) + " items, but " + needed(key) + " is needed");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

std::int64_t Table::integer(const Key& key) const {
  require_kind(key, Kind::integer);
  const Value& value = fetch(key);
  const auto* integer = std::get_if<std::int64_t>(&value.data);
  if (!integer) fail(key.name, "found " + describe_value(value) + ", but an integer is needed, like 100");
  if (const char* rule = broken_rule(key.range, static_cast<double>(*integer))) {
    fail(key.name, describe_value(value) + ' ' + rule);
  }
  return *integer;
}

bool Table::boolean(const Key& key) const {
  require_kind(key, Kind::boolean);
  const Value& value = fetch(key);
  const auto* boolean = std::get_if<bool>(&value.data);
  if (!boolean) fail(key.name, "found " + describe_value(value) + ", but true or false is needed");
  return *boolean;
}

std::string Table::text(const Key& key) const {
  if (key.kind != Kind::choice) require_kind(key, Kind::text);
  const Value& value = fetch(key);
  const auto* text = std::get_if<std::string>(&value.data);
  if (!text) fail(key.name, "found " + describe_value(value) + ", but " + needed(key) + " is needed");
  return *text;
}

std::string Table::choice(const Key& key) const {
  require_kind(key, Kind::choice);
  const std::string word = text(key);
  const std::vector<std::string> words = words_of(key.choices);
  for (const std::string& allowed : words) {
    if (word == allowed) return word;
  }
  fail(key.name, "unknown word \"" + word + '"' + suggestion(word, words));
}

Table Table::table(std::string_view name) const {
  Value* value = find(name);
  if (!value) {
    Value empty;
    empty.data = Value::Fields();
    value = &node_->add(std::string(name), std::move(empty));
  }
  if (!value->is_table()) fail(name, "found " + describe_value(*value) + ", but a table is needed");
  return {value, file_, path_of(name)};
}

std::vector<Table> Table::tables(std::string_view name) const {
  std::vector<Table> result;
  Value* value = find(name);
  if (!value) return result;
  const std::string wanted = ", but an array of tables is needed: [[" + path_of(name) + "]]";
  if (!value->is_array()) fail(name, "found " + describe_value(*value) + wanted);
  auto& items = std::get<Value::Array>(value->data);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is_table()) fail(name, "item " + std::to_string(i) + " is " + describe_value(items[i]) + wanted);
    result.push_back(Table(&items[i], file_, indexed(path_of(name), i)));
  }
  return result;
}

std::vector<std::string> Table::names() const {
  std::vector<std::string> names;
  for (const Field& field : node_->fields()) {
    node_->known.insert(field.name);
    names.push_back(field.name);
  }
  return names;
}

void Table::finish() const {
  require_all_known(*node_, *file_, path_);
}

}  // namespace npfem::text
