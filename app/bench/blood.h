// SPDX-License-Identifier: MPL-2.0
// The suspensions that npfem bench runs.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace npfem::app::bench {

/// "shear50_ht35": the shear box of the lineage, (50 um)^3 at 0.5 um, 35 % red cells and a platelet for every five, its
/// materials, 100 1/s, a cell step every second fluid step of 0.125 us. "shear25_ht35": a box of 25 um of the same.
/// "shear20_ht20": a small one for a test. Cells are placed at random, always the same.
flow::Scene blood_scene(const std::string& name, const std::vector<std::string>& assignments = {});

}  // namespace npfem::app::bench
