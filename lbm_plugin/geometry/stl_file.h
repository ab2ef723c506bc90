// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec3.h"

namespace npfem::flow {

/// A surface of triangles that share their vertices.
struct TriangleSurface {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;

  std::array<Vec3, 3> corners(std::size_t triangle) const {
    const auto& t = triangles[triangle];
    return {vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
            vertices[static_cast<std::size_t>(t[2])]};
  }
};

/// A surface from STL, binary or text. STL repeats every vertex in each triangle; vertices nearer to each other than a
/// millionth of the extent become one, and triangles that vanish thereby are dropped. text::InputError, with the line
/// or the triangle, where the bytes are not STL; `name` stands for the file.
TriangleSurface parse_stl(std::string_view bytes, const std::string& name);
TriangleSurface read_stl(const std::string& path);

}  // namespace npfem::flow
