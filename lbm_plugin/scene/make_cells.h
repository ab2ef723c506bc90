// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "scene/scene.h"

namespace npfem::flow {

/// Makes the model and the relaxed shape of each type of cell: fills scene.setup.types. text::InputError, with the
/// place in the scene, where a material, a mesh or an option cannot be used or the cell does not come to rest.
void make_types(Scene& scene);

/// Cells of each type that the scene asks for, listed ones included; needs the types.
std::vector<int> cell_counts(const Scene& scene);

struct PlacementReport {
  bool grown = false;  ///< random placement jammed, and the cells were grown from small
  int sweeps = 0;      ///< of that growth
};

/// Puts the cells into the domain: fills scene.setup.cells; needs the types. text::InputError where they do not fit.
PlacementReport place_scene_cells(Scene& scene);

/// Volume of the cells of each type over the volume open to the fluid.
std::vector<double> haematocrit_by_type(const Setup& setup, const std::vector<int>& counts);

}  // namespace npfem::flow
