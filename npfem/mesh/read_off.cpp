// SPDX-License-Identifier: MPL-2.0
// OFF (Geomview): "OFF", then the counts of vertices, faces and edges, then the vertices, then the faces.
#include "mesh/line_reader.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_formats.h"

namespace npfem {
namespace {

/// A count from the file; never larger than the file could hold, so that a wrong one cannot ask for all the memory.
int count(const LineReader& reader, std::string_view word, std::size_t file_size) {
  const int value = reader.to_int(word);
  if (value < 0 || static_cast<std::size_t>(value) > file_size) {
    reader.fail("the count " + std::to_string(value) + " does not fit a file of " + std::to_string(file_size) +
                " bytes");
  }
  return value;
}

}  // namespace

TriangleMesh parse_off(std::string_view content, const std::string& name) {
  LineReader reader(content, name, '#');
  reader.require_next("the word OFF");
  auto words = reader.words();
  if (words[0] != "OFF") reader.fail("found " + quoted_word(words[0]) + ", but the file must start with OFF");
  words.erase(words.begin());
  if (words.empty()) {
    reader.require_next("the counts of vertices, faces and edges");
    words = reader.words();
  }
  if (words.size() != 3) reader.fail("three counts are needed: vertices, faces, edges");
  const int num_vertices = count(reader, words[0], content.size());
  const int num_faces = count(reader, words[1], content.size());

  TriangleMesh mesh;
  for (int i = 0; i < num_vertices; ++i) {
    reader.require_next("a vertex");
    words = reader.words();
    if (words.size() != 3) reader.fail("vertex " + std::to_string(i) + " needs three coordinates");
    mesh.positions.push_back({reader.to_double(words[0]), reader.to_double(words[1]), reader.to_double(words[2])});
  }
  for (int i = 0; i < num_faces; ++i) {
    reader.require_next("a face");
    words = reader.words();
    if (words[0] != "3" || words.size() < 4) {
      reader.fail("face " + std::to_string(i) + " is not \"3 i j k\"; only triangles are read, triangulate first");
    }
    Triangle triangle;
    for (std::size_t n = 0; n < 3; ++n) triangle[n] = reader.to_int(words[n + 1]);
    for (std::size_t n = 4; n < words.size(); ++n) reader.to_double(words[n]);  // a colour may follow
    mesh.triangles.push_back(triangle);
  }
  if (reader.next_filled()) reader.fail("found " + quoted_word(reader.line()) + " after the last face");
  require_well_formed(mesh, name);
  return mesh;
}

}  // namespace npfem
