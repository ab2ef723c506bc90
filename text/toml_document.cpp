// SPDX-License-Identifier: MPL-2.0
// The document as a whole: read, changed by overrides, written back. toml_reader.cpp fetches the values.
#include <algorithm>
#include <charconv>
#include <utility>

#include "file.h"
#include "toml_reader.h"
#include "toml_value.h"

namespace npfem::text {
namespace {

/// Marks a value from --set, and all below it, with the argument it came from.
void mark_origin(Value& value, const std::string& origin) {
  value.origin = origin;
  if (value.is_table()) {
    for (Field& field : value.fields()) mark_origin(field.value, origin);
  } else if (value.is_array()) {
    for (Value& item : std::get<Value::Array>(value.data)) mark_origin(item, origin);
  }
}

/// One step of a path, "cells[1]" or "run".
struct Step {
  std::string name;
  int index = -1;
};

Step parse_step(std::string_view text, const std::string& origin) {
  Step step;
  const std::size_t bracket = text.find('[');
  step.name = text.substr(0, bracket);
  bool good = !step.name.empty();
  if (good && bracket != std::string_view::npos) {
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data() + bracket + 1, end, step.index);
    good = result.ec == std::errc() && step.index >= 0 && end - result.ptr == 1 && *result.ptr == ']';
  }
  if (!good) throw InputError(origin + ": a path looks like run.steps or cells[0].count");
  return step;
}

/// The table that `step` leads to from `table`, created when absent.
Value& descend(Value& table, const Step& step, const std::string& origin) {
  Value* child = table.find(step.name);
  if (step.index >= 0) {
    auto* items = child ? std::get_if<Value::Array>(&child->data) : nullptr;
    const auto count = items ? items->size() : 0;
    if (static_cast<std::size_t>(step.index) >= count) {
      throw InputError(origin + ": there is no " + step.name + '[' + std::to_string(step.index) + ']' +
                       "; the document has " + std::to_string(count));
    }
    child = &(*items)[static_cast<std::size_t>(step.index)];
  } else if (!child) {
    Value empty;
    empty.data = Value::Fields();
    empty.origin = origin;
    child = &table.add(step.name, std::move(empty));
  }
  if (!child->is_table()) throw InputError(origin + ": " + step.name + " is not a table");
  return *child;
}

}  // namespace

Document::Document(std::unique_ptr<Value> root, std::string name)
    : root_(std::move(root)), name_(std::make_unique<std::string>(std::move(name))) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Document Document::parse_file(const std::string& path) {
  try {
    return parse_text(read_file(path), path);
  } catch (const FileError& error) {
    throw InputError(error.what());
  }
}

Document Document::parse_text(std::string_view text, const std::string& name) {
  return {std::make_unique<Value>(parse_toml(text, name)), name};
}

void Document::set(std::string_view path, std::string_view value) {
  const std::string origin = "--set " + std::string(path) + '=' + std::string(value);
  constexpr auto most_dots = 200;  // as in a file
  if (std::count(path.begin(), path.end(), '.') > most_dots) {
    throw InputError("--set: the path has more than 200 parts; a path looks like run.steps or cells[0].count");
  }
  Value* table = root_.get();
  std::string_view rest = path;
  for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    table = &descend(*table, parse_step(rest.substr(0, dot), origin), origin);
    rest.remove_prefix(dot + 1);
  }
  const Step last = parse_step(rest, origin);
  if (last.index >= 0) throw InputError(origin + ": a path ends in a key, like run.steps or cells[0].count");
  Value parsed = parse_loose(value);
  mark_origin(parsed, origin);
  if (Value* present = table->find(last.name)) {
    *present = std::move(parsed);
  } else {
    table->add(last.name, std::move(parsed));
  }
}

void Document::set(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw InputError("--set " + std::string(assignment) + ": write --set path=value, like --set run.steps=100");
  }
  set(assignment.substr(0, equals), assignment.substr(equals + 1));
}

Table Document::root() const {
  return {root_.get(), name_.get(), ""};
}

std::string Document::to_toml() const {
  return print_toml(*root_);
}

}  // namespace npfem::text
