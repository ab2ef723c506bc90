// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "material/material.h"
#include "mesh/triangle_mesh.h"
#include "model/model.h"

namespace npfem {

/// A cell of the given shape and material. Each energy gets its own reference: the in-plane metric comes from the
/// stress-free shape that the material asks for, hinge angles, total area and volume from `mesh`. Energies of zero
/// weight are left out. Throws Error(bad_input) for a surface or a combination that cannot be built.
Model build_model(const TriangleMesh& mesh, const Material& material);

}  // namespace npfem
