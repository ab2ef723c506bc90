// SPDX-License-Identifier: MPL-2.0
// Triangle meshes from and to files, by the extension of the name: .off, .obj, .stl (text or binary), .ply (text or
// binary little-endian). Coordinates are taken as um. Readers check the file (counts, indices, finite numbers, nothing
// missing); whether the surface is closed is the business of require_valid_surface.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace npfem {

/// Throws Error(io) when the file cannot be read, Error(bad_input) with file:line when its content is wrong.
TriangleMesh read_mesh(const std::string& path);

/// Written beside `path` and renamed, so that no half-written mesh is left. Text formats keep every bit of the
/// positions; STL is binary and keeps single precision, as the format has it.
void write_mesh(const std::string& path, const TriangleMesh& mesh);

}  // namespace npfem
