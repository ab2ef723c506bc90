// SPDX-License-Identifier: MPL-2.0
// What a surface must be before physics is put on it: closed, oriented outwards, without degenerate or repeated parts.
#pragma once

#include <string_view>

#include "mesh/triangle_mesh.h"

namespace npfem {

/// Throws Error(bad_input) unless `mesh` is a closed, manifold, consistently and outwardly oriented surface with
/// finite, distinct, used vertices and no degenerate triangle. The message names `name` and the first offending item.
void require_valid_surface(const TriangleMesh& mesh, std::string_view name);

/// The part of it that any reader must give: something there, finite positions, indices in range.
void require_well_formed(const TriangleMesh& mesh, std::string_view name);

}  // namespace npfem
