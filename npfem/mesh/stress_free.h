// SPDX-License-Identifier: MPL-2.0
// The stress-free shape of a red-cell membrane, where it is taken to differ from the shape of the cell.
#pragma once

#include "mesh/triangle_mesh.h"

namespace npfem {

/// The oblate spheroid of the given reduced volume (0 < v <= 1) and of the same surface area as `cell`, with the same
/// vertices: each keeps its longitude and goes to the polar position that encloses the same fraction of the area as on
/// the cell, so that the shapes differ by in-plane shear and (up to the mesh) not by local area. The discrete area is
/// made equal exactly. `cell` must be a surface of revolution about z, centred at the origin and symmetric about z = 0;
/// Error(bad_input) where it plainly is not.
TriangleMesh oblate_reference(const TriangleMesh& cell, double reduced_volume);

}  // namespace npfem
