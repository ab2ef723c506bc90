// SPDX-License-Identifier: MPL-2.0
// The mesh formats, from and to memory. `name` stands for the file in messages.
#pragma once

#include <string>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace npfem {

TriangleMesh parse_off(std::string_view content, const std::string& name);
TriangleMesh parse_obj(std::string_view content, const std::string& name);
/// Vertices at identical positions are merged: an STL file lists the three corners of each triangle afresh.
TriangleMesh parse_stl(std::string_view content, const std::string& name);
TriangleMesh parse_ply(std::string_view content, const std::string& name);

std::string format_off(const TriangleMesh& mesh);
std::string format_obj(const TriangleMesh& mesh);
std::string format_stl(const TriangleMesh& mesh);  ///< binary
std::string format_ply(const TriangleMesh& mesh);  ///< binary little-endian, double precision

}  // namespace npfem
