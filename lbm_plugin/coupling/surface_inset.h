// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/immersed_solid.h"
#include "geometry/vec3.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// By how much a sphere drags like a larger one, in node spacings, with the kernel of 2, 3 or 4 points: measured in
/// a box of 8 radii at a radius of 4 nodes; with 4 points the same within 0.03 at 3 to 8 nodes and 10 to 20 radii
/// (I2B).
double kernel_excess(int kernel_points);

/// Where membranes meet the lattice, so that they drag as if they stood where their vertices are.
///
/// A surface that is smeared over the nodes of a kernel moves with the mean velocity of a layer of fluid, in which the
/// velocity has its kink; to the fluid outside it seems to stand farther out by a fixed part of the node spacing
/// (kernel_excess). The coupling therefore acts at markers
///   Y_i = x_i - d m_i,   m_i = n_i S0_i/S_i,
/// d that excess, n_i the unit normal at the vertex and S_i the area around it, S0_i in the shape of its type: the
/// layer between markers and surface keeps its volume, as the fluid inside the markers does. (At creases, where S is
/// below two thirds of S0, m follows the area vector itself and stays below 1.5.) Markers move with the fluid: u(Y) =
/// dY/dt = (1 - d N) v with N = dm/dx, so that
///   v = (1 - d N)^-1 u(Y),   force at Y = (1 - d N)^-T (force at x).
/// The pair is adjoint and so adds no energy; the total force and rigid motions pass unchanged. The inverse is summed
/// to third order in d over the lengths on which the surface bends.
///
/// All bodies are whole and cells of the setup. Threads share them.
class SurfaceInset {
 public:
  /// `depth`: d, um; with 0 markers are vertices. `setup` must outlive this.
  SurfaceInset(const Setup& setup, double depth);

  double depth() const { return depth_; }

  /// The markers of these vertices, xyz per vertex, um. What follows is about them.
  std::span<const double> place(std::span<const VertexId> vertices, std::span<const double> positions);
  /// Velocities of the markers become those of the vertices.
  void to_vertices(std::span<double> velocities);
  /// Forces on the vertices become those at the markers.
  void to_markers(std::span<double> forces);

 private:
  struct Body {
    std::size_t first, count;  // vertices
    std::size_t type;
  };
  void list_bodies(std::span<const VertexId> vertices);
  void place(const Body& body);
  const std::vector<std::int32_t>& triangles(const Body& body) const { return setup_.types[body.type].triangles; }
  Vec3 rate_of_offset(std::size_t vertex, const Vec3& change_of_area) const;
  void turn_offsets(const Body& body, const double* velocity, double* rate) const;
  void turn_offsets_transposed(const Body& body, const double* moment, double* force);
  template <class Visit>
  void for_each(Visit&& visit);
  template <class Turn>
  void sum_series(const Body& body, double* values, Turn&& turn);

  const Setup& setup_;
  double depth_;
  std::vector<Body> bodies_;
  std::vector<std::vector<double>> rest_area_;  // by type and vertex: S0, six times the vertex's share, um2
  std::vector<double> positions_, markers_, normals_;
  std::vector<double> per_square_;  // S0/S^2 by vertex, 1/um2
  std::vector<double> term_, next_, along_;
};

}  // namespace npfem::flow
