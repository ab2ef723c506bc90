// SPDX-License-Identifier: MPL-2.0
// STL: a bag of triangles, each with its own three corners. Binary: 80 bytes, a count, 50 bytes a triangle.
#include <cmath>
#include <map>

#include "error.h"
#include "mesh/binary.h"
#include "mesh/line_reader.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_formats.h"
#include "mesh/point_math.h"

namespace npfem {
namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t record_size = 50;

/// Collects corners into vertices: corners at one position are one vertex.
class Merger {
 public:
  int vertex(const Point& corner) {
    const Point key = sum(corner, Point{0, 0, 0});  // -0 and 0 are the same place
    const auto [it, is_new] = vertices_.try_emplace(key, static_cast<int>(mesh.positions.size()));
    if (is_new) mesh.positions.push_back(key);
    return it->second;
  }

  TriangleMesh mesh;

 private:
  std::map<Point, int> vertices_;
};

bool is_binary(std::string_view content) {
  if (content.size() < header_size) return false;
  const std::uint32_t count = load<std::uint32_t>(content.substr(80));
  return content.size() == header_size + record_size * std::size_t{count};
}

TriangleMesh parse_binary(std::string_view content, const std::string& name) {
  Merger merger;
  const std::uint32_t count = load<std::uint32_t>(content.substr(80));
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::string_view record = content.substr(header_size + record_size * t, record_size);
    Triangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Point p;
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = static_cast<double>(load<float>(record.substr(12 + 12 * corner + 4 * i)));
      if (!std::isfinite(p[0] + p[1] + p[2])) {
        throw Error(Status::bad_input,
                    name + ": triangle " + std::to_string(t) + " has a coordinate that is not finite");
      }
      triangle[corner] = merger.vertex(p);
    }
    merger.mesh.triangles.push_back(triangle);
  }
  return merger.mesh;
}

void require_words(LineReader& reader, std::string_view first, std::string_view second, std::size_t count) {
  reader.require_next("the rest of a facet");
  const auto words = reader.words();
  if (words.size() == count && words[0] == first && (second.empty() || words[1] == second)) return;
  reader.fail("found " + quoted_word(reader.line()) + ", but \"" + std::string(first) + (second.empty() ? "" : " ") +
              std::string(second) + "\" is expected");
}

TriangleMesh parse_text(std::string_view content, const std::string& name) {
  LineReader reader(content, name);
  reader.require_next("the word solid");
  Merger merger;
  while (true) {
    reader.require_next("a facet or endsolid");
    const auto words = reader.words();
    if (words[0] == "endsolid") break;
    if (words.size() != 5 || words[0] != "facet" || words[1] != "normal") {
      reader.fail("found " + quoted_word(reader.line()) + ", but \"facet normal x y z\" or \"endsolid\" is expected");
    }
    require_words(reader, "outer", "loop", 2);
    Triangle triangle;
    for (int& vertex : triangle) {
      require_words(reader, "vertex", "", 4);
      const auto xyz = reader.words();
      vertex = merger.vertex({reader.to_double(xyz[1]), reader.to_double(xyz[2]), reader.to_double(xyz[3])});
    }
    require_words(reader, "endloop", "", 1);
    require_words(reader, "endfacet", "", 1);
    merger.mesh.triangles.push_back(triangle);
  }
  if (reader.next_filled()) reader.fail("found " + quoted_word(reader.line()) + " after endsolid");
  return merger.mesh;
}

}  // namespace

TriangleMesh parse_stl(std::string_view content, const std::string& name) {
  // Some programs start a binary file with "solid" too: the size decides.
  if (!is_binary(content) && !content.starts_with("solid")) {
    throw Error(Status::bad_input,
                name +
                    ": neither a text STL (it would start with \"solid\") nor a whole binary one (84 bytes and 50 "
                    "per triangle; the file has " +
                    std::to_string(content.size()) + " bytes)");
  }
  TriangleMesh mesh = is_binary(content) ? parse_binary(content, name) : parse_text(content, name);
  require_well_formed(mesh, name);
  return mesh;
}

}  // namespace npfem
