// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/lineage_body.h"
#include "model/model.h"

namespace npfem {

/// One constraint of the lineage, with the shape its vertices had when it was added: its rest shape.
struct LineageElement {
  LineageConstraint constraint;
  std::array<Point, 4> rest{};
};

struct LineageMass {
  double density;        ///< fg/um3; a vertex carries density * V0 / n
  double volume_weight;  ///< pN/um, global volume; 0: none
};

/// The number of vertices and scalars that a constraint type takes; {0, 0} for a name that cannot be built.
struct LineageArity {
  int ids, scalars;
};
LineageArity lineage_arity(const std::string& type);
/// The constraint types that can be built: "SurfaceMaterial, Area, ...".
std::string lineage_types();

/// A cell as the lineage builds it: one element per constraint, rest volume of the present points over the
/// SurfaceMaterial triangles. Throws Error(bad_input) for a type, an id or a count that cannot be built.
Model build_lineage_model(const std::vector<Point>& points, const std::vector<LineageElement>& elements,
                          const LineageMass& mass);

/// From a body folder: every element is at rest in the points of the folder.
Model build_lineage_model(const LineageBody& body, const LineageMass& mass);

}  // namespace npfem
