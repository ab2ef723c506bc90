// SPDX-License-Identifier: MPL-2.0
// OBJ (Wavefront): lines "v x y z" and "f i j k" with vertices numbered from 1, or backwards from -1. Normals, texture
// coordinates, groups and materials say nothing about the surface and are passed over.
#include <algorithm>
#include <array>

#include "mesh/line_reader.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_formats.h"

namespace npfem {
namespace {

constexpr std::array<std::string_view, 8> passed_over = {"vn", "vt", "g", "o", "s", "usemtl", "mtllib", "l"};

/// The vertex of a face corner "i", "i/t", "i//n" or "i/t/n", counted from 0.
int corner(const LineReader& reader, std::string_view word, std::size_t num_vertices) {
  const int index = reader.to_int(word.substr(0, word.find('/')));
  const int count = static_cast<int>(num_vertices);
  const int vertex = index < 0 ? count + index : index - 1;
  if (index == 0 || vertex < 0 || vertex >= count) {
    reader.fail("the face refers to vertex " + std::to_string(index) + ", but there are " + std::to_string(count) +
                " before this line, numbered from 1");
  }
  return vertex;
}

}  // namespace

TriangleMesh parse_obj(std::string_view content, const std::string& name) {
  LineReader reader(content, name, '#');
  TriangleMesh mesh;
  while (reader.next_filled()) {
    const auto words = reader.words();
    if (words[0] == "v") {
      if (words.size() != 4 && words.size() != 5 && words.size() != 7) {
        reader.fail("a vertex is \"v x y z\" (a weight or a colour may follow)");
      }
      for (std::size_t n = 4; n < words.size(); ++n) reader.to_double(words[n]);
      mesh.positions.push_back({reader.to_double(words[1]), reader.to_double(words[2]), reader.to_double(words[3])});
    } else if (words[0] == "f") {
      if (words.size() != 4) {
        reader.fail("a face of " + std::to_string(words.size() - 1) +
                    " corners; only triangles are read, triangulate first");
      }
      const std::size_t n = mesh.positions.size();
      mesh.triangles.push_back({corner(reader, words[1], n), corner(reader, words[2], n), corner(reader, words[3], n)});
    } else if (std::find(passed_over.begin(), passed_over.end(), words[0]) == passed_over.end()) {
      reader.fail("unknown keyword " + quoted_word(words[0]) + "; a mesh has lines v and f");
    }
  }
  require_well_formed(mesh, name);
  return mesh;
}

}  // namespace npfem
