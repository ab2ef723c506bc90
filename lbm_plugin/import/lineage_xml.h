// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace npfem::flow {

/// The parameter file of the lineage (Palabos-npFEM): XML without a root, whose comments look like
/// `<!--> text <-->`. Every element without children is a value; blanks around it do not count.
class LineageXml {
 public:
  /// `name` stands for the file in messages. text::InputError with name:line where the tags do not nest, a value is
  /// given twice, or a comment does not end.
  static LineageXml parse(std::string_view text, const std::string& name);

  /// The value at a path like "System_Setup/dx_p". text::InputError where it is missing.
  const std::string& text(const std::string& path) const;
  double number(const std::string& path) const;
  double positive(const std::string& path) const;
  int whole_number(const std::string& path, int least) const;
  bool boolean(const std::string& path) const;

  /// The paths that nobody has asked for so far.
  std::vector<std::string> unused() const;

  /// Throws an InputError that names file, line and key.
  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

 private:
  struct Element {
    std::string value;
    int line = 0;
    mutable bool used = false;
  };
  std::string name_;
  std::map<std::string, Element> elements_;  // by path
};

}  // namespace npfem::flow
