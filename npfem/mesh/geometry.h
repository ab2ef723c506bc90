// SPDX-License-Identifier: MPL-2.0
// Measures of a triangulated surface, in powers of um.
#pragma once

#include <array>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"

namespace npfem {

struct EdgeLengths {
  double min, mean, max;  ///< um
};

/// Principal axes of the body that a closed surface encloses.
struct PrincipalAxes {
  std::array<double, 3>
      second_moment;          ///< integral of (x - centroid)^2 over the volume along each axis, ascending, um^5
  std::array<Point, 3> axis;  ///< unit vectors, right-handed; axis[0] is the short axis of a flat body
};

double triangle_area(const TriangleMesh& mesh, int triangle);
double surface_area(const TriangleMesh& mesh);
/// Positive when the triangles are counter-clockwise seen from outside.
double signed_volume(const TriangleMesh& mesh);
/// 6 sqrt(pi) V / A^1.5: 1 for a sphere, 0.64 for a red cell.
double reduced_volume(const TriangleMesh& mesh);
/// Centre of the enclosed volume, um.
Point volume_centroid(const TriangleMesh& mesh);
/// Mean of the vertices, um.
Point mean_position(const TriangleMesh& mesh);
/// Largest minus smallest coordinate along x, y, z.
Point extents(const TriangleMesh& mesh);
/// One third of the area of the triangles at each vertex, um^2.
std::vector<double> vertex_areas(const TriangleMesh& mesh);
EdgeLengths edge_lengths(const TriangleMesh& mesh);
PrincipalAxes principal_axes(const TriangleMesh& mesh);
/// Angle between the outward normals of the two triangles, rad: 0 flat, positive where the surface is convex, as on a
/// sphere; in (-pi, pi].
double dihedral_angle(const TriangleMesh& mesh, const Hinge& hinge);

}  // namespace npfem
