// SPDX-License-Identifier: MPL-2.0
// Surfaces of known shape: a subdivided sphere, mapped to a red cell, a platelet or a sphere of given size.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace npfem {

inline constexpr int max_mesh_level = 8;

/// Unit sphere from the octahedron by midpoint subdivision, projected at each level (the meshes of the lineage):
/// 4^(level+1) + 2 vertices (6, 18, 66, 258, 1026, 4098).
TriangleMesh octahedral_sphere(int level);
/// Unit sphere from the icosahedron, likewise: 10 4^level + 2 vertices (12, 42, 162, 642, 2562).
TriangleMesh icosahedral_sphere(int level);

/// The red cell at rest after Evans & Fung (1972): x, y = R0 s_x, R0 s_y and z = s_z (R0/2)(c0 + c1 q + c2 q^2) with
/// s on the unit sphere, q = s_x^2 + s_y^2, c = 0.207161, 2.002558, -1.122762, R0 = half the diameter, z its axis.
TriangleMesh evans_fung_cell(int level, double diameter_um = 7.82);

/// An oblate spheroid with its axis along z; the default is the resting platelet.
TriangleMesh oblate_spheroid(int level, double diameter_um = 3.6, double thickness_um = 1.1);

/// The names that generate_mesh knows: "rbc", "platelet", "sphere" (octahedral), "icosphere".
std::vector<std::string> mesh_shapes();

/// A shape by name. `diameter_um` is its largest diameter (proportions are kept); 0 takes the natural one: 7.82 um for
/// the red cell, 3.6 um for the platelet, 2 um (the unit sphere) for the spheres.
TriangleMesh generate_mesh(std::string_view shape, int level, double diameter_um = 0);

}  // namespace npfem
