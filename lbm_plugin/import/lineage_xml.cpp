// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_xml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include "nearest.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

struct Open {
  std::string name;
  std::string value;
  int line;
  bool has_children = false;
};

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  template <class Found>  // called with path, value, line
  void run(const Found& found) {
    while (at_ < text_.size()) {
      const std::size_t tag = std::min(text_.find('<', at_), text_.size());
      take_text(text_.substr(at_, tag - at_));
      advance(tag);
      if (at_ == text_.size()) break;
      if (text_.substr(at_).starts_with("<!--")) {
        // the comment's own first ">" belongs to its text
        skip_to("-->", at_ + 4, "a comment that does not end");
      } else if (text_.substr(at_).starts_with("<?") || text_.substr(at_).starts_with("<!")) {
        skip_to(">", at_, "a tag that does not end");
      } else {
        take_tag(found);
      }
    }
    if (!open_.empty()) fail(open_.back().line, std::string("<").append(open_.back().name).append("> is not closed"));
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw text::InputError(name_ + ":" + std::to_string(line) + ": " + message);
  }

  void advance(std::size_t to) {
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
    at_ = to;
  }

  void skip_to(std::string_view end, std::size_t from, const char* complaint) {
    const std::size_t found = text_.find(end, from);
    if (found == std::string_view::npos) fail(line_, std::string("found ") + complaint);
    advance(found + end.size());
  }

  void take_text(std::string_view text) {
    if (!open_.empty()) open_.back().value += text;
    if (open_.empty() && !trimmed(text).empty()) fail(line_, "found text outside of any element");
  }

  template <class Found>
  void take_tag(const Found& found) {
    const int line = line_;
    const std::size_t begin = at_ + 1;
    skip_to(">", at_, "a tag that does not end");
    std::string_view tag = text_.substr(begin, at_ - 1 - begin);
    const bool closes = tag.starts_with("/");
    const bool is_empty = tag.ends_with("/");
    if (closes) tag.remove_prefix(1);
    if (is_empty) tag.remove_suffix(1);
    const std::string name(tag.substr(0, tag.find_first_of(blanks)));
    if (name.empty()) fail(line, "found a tag without a name");
    if (!closes) {
      if (!open_.empty()) open_.back().has_children = true;
      open_.push_back({name, "", line});
    }
    if (closes || is_empty) close(name, line, found);
  }

  template <class Found>
  void close(const std::string& name, int line, const Found& found) {
    if (open_.empty() || open_.back().name != name) {
      std::string message = "</";
      message += name;
      message += "> closes ";
      message += open_.empty() ? "nothing" : "another element than the last one opened, in line ";
      if (!open_.empty()) message += std::to_string(open_.back().line);
      fail(line, message);
    }
    std::string path;
    for (const Open& element : open_) path += (path.empty() ? "" : "/") + element.name;
    if (!open_.back().has_children) found(path, trimmed(open_.back().value), open_.back().line);
    open_.pop_back();
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Open> open_;
};

}  // namespace

LineageXml LineageXml::parse(std::string_view text, const std::string& name) {
  LineageXml xml;
  xml.name_ = name;
  Parser(text, name).run([&](const std::string& path, const std::string& value, int line) {
    const auto [element, is_new] = xml.elements_.insert({path, {value, line, false}});
    if (!is_new) {
      throw text::InputError(name + ":" + std::to_string(line) + ": " + path + " is given already, in line " +
                             std::to_string(element->second.line));
    }
  });
  return xml;
}

const std::string& LineageXml::text(const std::string& path) const {
  const auto found = elements_.find(path);
  if (found != elements_.end()) {
    found->second.used = true;
    return found->second.value;
  }
  std::vector<std::string> paths;
  for (const auto& [known, element] : elements_) paths.push_back(known);
  const std::string near = text::nearest(path, paths);
  throw text::InputError(
      name_ + ": missing key " + path +
      (near.empty() ? "" : "; there is " + near + " in line " + std::to_string(elements_.at(near).line)));
}

double LineageXml::number(const std::string& path) const {
  const std::string& word = text(path);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    fail(path, "found \"" + word + "\" where a number is needed");
  }
  return value;
}

double LineageXml::positive(const std::string& path) const {
  const double value = number(path);
  if (!(value > 0)) fail(path, text(path) + " must be greater than 0");
  return value;
}

int LineageXml::whole_number(const std::string& path, int least) const {
  const double value = number(path);
  if (value != std::floor(value) || value < least || value > 1e9) {
    fail(path, text(path) + " is not allowed: a whole number from " + std::to_string(least) + " on is needed");
  }
  return static_cast<int>(value);
}

bool LineageXml::boolean(const std::string& path) const {
  std::string word = text(path);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word != "true" && word != "false") fail(path, "found \"" + text(path) + "\" where true or false is needed");
  return word == "true";
}

std::vector<std::string> LineageXml::unused() const {
  std::vector<std::string> paths;
  for (const auto& [path, element] : elements_) {
    if (!element.used) paths.push_back(path);
  }
  return paths;
}

void LineageXml::fail(const std::string& path, const std::string& message) const {
  const auto found = elements_.find(path);
  std::string place = name_;
  if (found != elements_.end()) place.append(":").append(std::to_string(found->second.line));
  throw text::InputError(place + ": " + path + ": " + message);
}

}  // namespace npfem::flow
