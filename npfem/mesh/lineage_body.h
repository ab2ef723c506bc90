// SPDX-License-Identifier: MPL-2.0
// A body folder of the lineage (ShapeOp / Palabos-npFEM): points.csv, surface_connectivity.csv, constraints.csv and
// onSurfaceParticle.csv. Lines end in LF or CRLF.
#pragma once

#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace npfem {

/// One row of constraints.csv. The lineage parses weight and scalars in single precision and widens them; so do we,
/// for identical numbers.
struct LineageConstraint {
  std::string type;             ///< "Bending", "SurfaceMaterial", "Area", ...
  std::vector<int> ids;         ///< vertices
  double weight;                ///< unit by type: pN um for Bending, uN/m for SurfaceMaterial and Area
  std::vector<double> scalars;  ///< rangeMin rangeMax [mu lambda kappa]
};

struct LineageBody {
  TriangleMesh surface;
  std::vector<LineageConstraint> constraints;
  std::vector<int> on_surface;  ///< per vertex: 1 = seen by the fluid, 0 = inside a solid
};

/// Throws Error(io) or Error(bad_input) with file:line. Every count, id and type is checked.
LineageBody read_lineage_body(const std::string& folder);

/// The four files from memory, for read_lineage_body and for tests.
struct LineageFiles {
  std::string points, surface_connectivity, constraints, on_surface;
};
LineageBody parse_lineage_body(const LineageFiles& files, const std::string& folder);

}  // namespace npfem
