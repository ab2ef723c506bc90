// SPDX-License-Identifier: MPL-2.0
// PLY (Stanford): a header that describes its elements, then their values as text or as little-endian bytes. Elements
// and properties other than the vertex positions and the triangles are passed over.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "error.h"
#include "mesh/binary.h"
#include "mesh/line_reader.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_formats.h"

namespace npfem {
namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Number type;
  std::optional<Number> count_type;  ///< of a list
};

struct Element {
  std::string name;
  int count;
  std::vector<Property> properties;
};

struct Header {
  bool is_binary = false;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes
  int num_lines = 0;
};

Number parse_type(const LineReader& reader, std::string_view word) {
  static constexpr std::pair<std::string_view, Number> names[] = {
      {"char", Number::int8},   {"uchar", Number::uint8},   {"short", Number::int16},     {"ushort", Number::uint16},
      {"int", Number::int32},   {"uint", Number::uint32},   {"float", Number::float32},   {"double", Number::float64},
      {"int8", Number::int8},   {"uint8", Number::uint8},   {"int16", Number::int16},     {"uint16", Number::uint16},
      {"int32", Number::int32}, {"uint32", Number::uint32}, {"float32", Number::float32}, {"float64", Number::float64}};
  for (const auto& [name, type] : names) {
    if (word == name) return type;
  }
  reader.fail("unknown number type " + quoted_word(word));
}

Property parse_property(const LineReader& reader, const std::vector<std::string_view>& words) {
  if (words.size() == 3) return {std::string(words[2]), parse_type(reader, words[1]), {}};
  if (words.size() == 5 && words[1] == "list") {
    return {std::string(words[4]), parse_type(reader, words[3]), parse_type(reader, words[2])};
  }
  reader.fail("a property is \"property type name\" or \"property list type type name\"");
}

Header parse_header(std::string_view content, const std::string& name) {
  LineReader reader(content, name);
  Header header;
  reader.require_next("the word ply");
  if (reader.line() != "ply") reader.fail("the file must start with ply");
  reader.require_next("the format");
  if (reader.line() != "format ascii 1.0" && reader.line() != "format binary_little_endian 1.0") {
    reader.fail("found " + quoted_word(reader.line()) +
                ", but \"format ascii 1.0\" or \"format binary_little_endian 1.0\" is needed");
  }
  header.is_binary = reader.line() != "format ascii 1.0";
  while (true) {
    reader.require_next("end_header");
    const auto words = reader.words();
    if (words[0] == "end_header") break;
    if (words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "element" && words.size() == 3) {
      const int count = reader.to_int(words[2]);
      if (count < 0 || static_cast<std::size_t>(count) > content.size()) {
        reader.fail("the count " + std::to_string(count) + " does not fit a file of " + std::to_string(content.size()) +
                    " bytes");
      }
      header.elements.push_back({std::string(words[1]), count, {}});
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(parse_property(reader, words));
    } else {
      reader.fail("found " + quoted_word(reader.line()) + ", but an element, a property or end_header is expected");
    }
  }
  header.size = static_cast<std::size_t>(reader.line().data() - content.data()) + reader.line().size();
  header.size = std::min(content.size(), content.find('\n', header.size) + 1);
  header.num_lines = reader.number();
  return header;
}

/// The values after the header, one after the other, each widened to double.
class Values {
 public:
  Values(std::string_view body, const Header& header, const std::string& name)
      : rest_(body), is_binary_(header.is_binary), line_(header.num_lines + 1), name_(name) {}

  double next(Number type) { return is_binary_ ? next_binary(type) : next_text(); }

  int next_int(Number type) {
    const double value = next(type);
    if (value != std::floor(value) || std::abs(value) > 2147483647.0) fail("an integer is needed");
    return static_cast<int>(value);
  }

  void finish() {
    if (!is_binary_) skip_blanks();
    if (!rest_.empty()) fail("there is more in the file than the header says");
  }

  [[noreturn]] void fail(const std::string& message) const {
    const std::string place = is_binary_ ? ": " : ':' + std::to_string(line_) + ": ";
    throw Error(Status::bad_input, name_ + place + message);
  }

 private:
  template <class T>
  double take() {
    if (rest_.size() < sizeof(T)) fail("the file is shorter than its header says");
    const double value = static_cast<double>(load<T>(rest_));
    rest_.remove_prefix(sizeof(T));
    return value;
  }

  double next_binary(Number type) {
    switch (type) {
      case Number::int8:
        return take<std::int8_t>();
      case Number::uint8:
        return take<std::uint8_t>();
      case Number::int16:
        return take<std::int16_t>();
      case Number::uint16:
        return take<std::uint16_t>();
      case Number::int32:
        return take<std::int32_t>();
      case Number::uint32:
        return take<std::uint32_t>();
      case Number::float32:
        return take<float>();
      case Number::float64:
        break;
    }
    return take<double>();
  }

  double next_text() {
    skip_blanks();
    if (rest_.empty()) fail("the file is shorter than its header says");
    const std::size_t length = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    double value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size()) {
      fail("found " + quoted_word(word) + ", but a number is needed");
    }
    return value;
  }

  void skip_blanks() {
    while (!rest_.empty() && std::string_view(" \t\r\n").find(rest_.front()) != std::string_view::npos) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
  }

  std::string_view rest_;
  bool is_binary_;
  int line_;
  const std::string& name_;
};

void read_vertex(const Element& element, Values& values, TriangleMesh& mesh) {
  Point p{};
  for (const Property& property : element.properties) {
    if (property.count_type) values.fail("a list among the properties of the vertices is not supported");
    const double value = values.next(property.type);
    for (std::size_t i = 0; i < 3; ++i) {
      if (property.name == std::string_view("xyz").substr(i, 1)) p[i] = value;
    }
  }
  mesh.positions.push_back(p);
}

void read_face(const Element& element, Values& values, TriangleMesh& mesh) {
  for (const Property& property : element.properties) {
    if (!property.count_type) {
      values.next(property.type);
      continue;
    }
    const int count = values.next_int(*property.count_type);
    const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    if (is_corners && count != 3) {
      values.fail("face " + std::to_string(mesh.triangles.size()) + " has " + std::to_string(count) +
                  " corners; only triangles are read, triangulate first");
    }
    if (is_corners) mesh.triangles.emplace_back();
    for (int i = 0; i < count; ++i) {
      const double value = is_corners ? values.next_int(property.type) : values.next(property.type);
      if (is_corners) mesh.triangles.back()[static_cast<std::size_t>(i)] = static_cast<int>(value);
    }
  }
}

void pass_over(const Element& element, Values& values) {
  for (const Property& property : element.properties) {
    const int count = property.count_type ? values.next_int(*property.count_type) : 1;
    for (int i = 0; i < count; ++i) values.next(property.type);
  }
}

void require_property(const Header& header, const char* element_name, std::vector<std::string> names,
                      const std::string& file) {
  for (const Element& element : header.elements) {
    if (element.name != element_name) continue;
    for (const Property& property : element.properties) std::erase(names, property.name);
    if (names.empty()) return;
  }
  throw Error(Status::bad_input,
              file + ": the header gives no property \"" + names.front() + "\" of an element \"" + element_name + '"');
}

}  // namespace

TriangleMesh parse_ply(std::string_view content, const std::string& name) {
  const Header header = parse_header(content, name);
  require_property(header, "vertex", {"x", "y", "z"}, name);
  TriangleMesh mesh;
  Values values(content.substr(header.size), header, name);
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (int i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        read_vertex(element, values, mesh);
      } else if (element.name == "face") {
        read_face(element, values, mesh);
      } else {
        pass_over(element, values);
      }
    }
  }
  values.finish();
  require_well_formed(mesh, name);
  return mesh;
}

}  // namespace npfem
