// SPDX-License-Identifier: MPL-2.0
// The four formats on their way out. Text keeps every bit of the positions; STL is in single precision by definition.
#include "mesh/binary.h"
#include "mesh/mesh_formats.h"
#include "mesh/point_math.h"
#include "quantity.h"

namespace npfem {

std::string format_off(const TriangleMesh& mesh) {
  std::string out =
      "OFF\n" + std::to_string(mesh.positions.size()) + ' ' + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Point& p : mesh.positions) {
    out += text::format_number(p[0]) + ' ' + text::format_number(p[1]) + ' ' + text::format_number(p[2]) + '\n';
  }
  for (const auto& [i, j, k] : mesh.triangles) {
    out += "3 " + std::to_string(i) + ' ' + std::to_string(j) + ' ' + std::to_string(k) + '\n';
  }
  return out;
}

std::string format_obj(const TriangleMesh& mesh) {
  std::string out;
  for (const Point& p : mesh.positions) {
    out += "v " + text::format_number(p[0]) + ' ' + text::format_number(p[1]) + ' ' + text::format_number(p[2]) + '\n';
  }
  for (const auto& [i, j, k] : mesh.triangles) {
    out += "f " + std::to_string(i + 1) + ' ' + std::to_string(j + 1) + ' ' + std::to_string(k + 1) + '\n';
  }
  return out;
}

std::string format_stl(const TriangleMesh& mesh) {
  std::string out = "npfem, lengths in um";
  out.resize(80, ' ');
  store(static_cast<std::uint32_t>(mesh.triangles.size()), out);
  const auto store_point = [&out](const Point& p) {
    for (const double x : p) store(static_cast<float>(x), out);
  };
  for (const Triangle& t : mesh.triangles) {
    const Point normal = area_vector(mesh, t);
    const double length = norm(normal);
    store_point(length > 0 ? scaled(1 / length, normal) : normal);
    for (const int vertex : t) store_point(mesh.positions[static_cast<std::size_t>(vertex)]);
    store(std::uint16_t{0}, out);
  }
  return out;
}

std::string format_ply(const TriangleMesh& mesh) {
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment npfem, lengths in um\nelement vertex " +
                    std::to_string(mesh.positions.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point& p : mesh.positions) {
    for (const double x : p) store(x, out);
  }
  for (const Triangle& t : mesh.triangles) {
    store(std::uint8_t{3}, out);
    for (const int vertex : t) store(std::int32_t{vertex}, out);
  }
  return out;
}

}  // namespace npfem
