// SPDX-License-Identifier: MPL-2.0
// A strict reader over a TOML document: every value is fetched through its Key, and what nobody asked for is an error.
// Every message starts with file:line:column and carries the path of the value, like cells[1].material.
//
//   Document scene = Document::parse_file("scene.toml");
//   scene.set("run.steps", "100");                         // --set run.steps=100
//   Table fluid = scene.root().table("fluid");
//   double viscosity = fluid.quantity(keys::viscosity);    // base units
//   scene.root().finish();                                 // unknown keys, with the nearest known one
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "key.h"

namespace npfem::text {

/// `text` as a TOML string with its quotes and escapes.
std::string toml_string(std::string_view text);

struct Value;  // one node of the document (toml_value.h)

/// A view of one table of a Document, which must outlive it.
class Table {
 public:
  /// In base units. A key left out takes its fallback, which also enters the document (see Document::to_toml).
  double quantity(const Key& key) const;
  std::vector<double> quantities(const Key& key) const;
  std::array<double, 3> vector3(const Key& key) const;
  std::int64_t integer(const Key& key) const;
  bool boolean(const Key& key) const;
  std::string text(const Key& key) const;
  std::string choice(const Key& key) const;

  /// True when the key (or the table) is given; either way the name counts as known from now on.
  bool has(std::string_view name) const;
  bool has(const Key& key) const { return has(std::string_view(key.name)); }

  /// A sub-table; an absent one is empty (its required keys are then reported missing).
  Table table(std::string_view name) const;
  /// An array of tables, [[name]]; an absent one has no element.
  std::vector<Table> tables(std::string_view name) const;
  /// The names present, in the order of the file, for tables whose keys are data.
  std::vector<std::string> names() const;

  /// Throws for the first key, here or below, that was never asked for.
  void finish() const;

  /// Throws an InputError located at the value of `name` (at the table when it is absent).
  [[noreturn]] void fail(std::string_view name, const std::string& message) const;
  /// The same message without throwing it, for warnings.
  std::string located(std::string_view name, const std::string& message) const;
  /// Throws an InputError located at the table itself.
  [[noreturn]] void fail(const std::string& message) const;

  const std::string& path() const { return path_; }  ///< "cells[1]", "" for the root

 private:
  friend class Document;
  Table(Value* node, const std::string* file, std::string path);
  Value& fetch(const Key& key) const;
  Value* find(std::string_view name) const;
  std::string where(const Value& value) const;
  std::string path_of(std::string_view name) const;
  double number_in(const Key& key, const Value& value) const;

  Value* node_;
  const std::string* file_;
  std::string path_;
};

/// A TOML document: parsed whole, changed by overrides, read through tables, written back.
class Document {
 public:
  static Document parse_file(const std::string& path);
  /// `name` stands for the file in messages.
  static Document parse_text(std::string_view text, const std::string& name);

  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Sets the value at a path like "run.steps" or "cells[1].material", creating tables on the way. `value` is TOML, or,
  /// when it does not parse as TOML, a string: set("fluid.viscosity", "1.2 mPa s").
  void set(std::string_view path, std::string_view value);
  /// The same from one argument, "run.steps=100".
  void set(std::string_view assignment);

  Table root() const;
  const std::string& name() const { return *name_; }

  /// The document as TOML, overrides and the defaults fetched so far included: everything a run was made from.
  std::string to_toml() const;

 private:
  Document(std::unique_ptr<Value> root, std::string name);

  std::unique_ptr<Value> root_;
  std::unique_ptr<std::string> name_;
};

}  // namespace npfem::text
