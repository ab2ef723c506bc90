// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/arc_tangent.h"
#include "energies/hinge.h"
#include "energies/ring.h"

namespace npfem {

/// Helfrich's bending energy, 2 kappa times the integral of (H - H0)^2, on the ring of each vertex:
///   E = 2 kappa (M - A H0)^2 / A,
/// A: one third of the vertex's triangles, M: integral of the mean curvature H (positive where convex) over A, which
/// Measure supplies with its gradient. H0 is half of Helfrich's spontaneous curvature c0. The energy of a closed
/// surface tends to the continuum's as the mesh is refined, and does not depend on the size of the cell.
template <class Measure>
struct CurvatureBending {
  static constexpr const char* name = Measure::name;
  static constexpr int max_vertices = max_ring_vertices;
  static constexpr bool zero_at_rest = true;

  template <class R>
  struct Params {
    R modulus;                ///< kappa, pN um (1e-18 J)
    R spontaneous_curvature;  ///< H0, 1/um, where `uniform` is 1
    R uniform;                ///< 1: H0 as given; 0: the mean curvature of the rest shape, vertex by vertex
  };
  template <class R>
  struct Rest {
    R curvature;                     ///< H0, 1/um
    R area;                          ///< um^2
    R laplacian[max_ring_vertices];  ///< of the rest shape, 1
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* x, int count, const Params<R>& params) {
    Rest<R> rest;
    Vec3<R> unused[max_vertices];
    rest.area = ring_area(x, count, unused);
    const R own = Measure::mean_curvature(x, count, unused) / rest.area;
    rest.curvature = select(params.uniform > R(0), params.spontaneous_curvature, own);
    for (int i = count; i < max_vertices; ++i) rest.laplacian[i] = R(0);
    ring_laplacian(x, count, rest.laplacian);
    return rest;
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T>* x, int count, const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T>* gradient) {
    Vec3<T> area_gradient[max_vertices];
    // A vertex whose triangles have vanished keeps a trace of area: a finite energy.
    const T smallest = T(R(1e-3) * rest.area), present = ring_area(x, count, area_gradient);
    const T area = larger(present, smallest);
    const T integral = Measure::mean_curvature(x, count, gradient);
    const T excess = integral / area - rest.curvature;  // H - H0, 1/um
    const T by_integral = R(4) * params.modulus * excess;
    const T by_area =
        select(present < smallest, T(R(0)), R(-2) * params.modulus * excess * (excess + R(2) * rest.curvature));
    for (int i = 0; i < count; ++i) gradient[i] = by_integral * gradient[i] + by_area * area_gradient[i];
    return R(2) * params.modulus * area * excess * excess;
  }

  /// Near a flat rest shape 2 H A n is the Laplacian row applied to x, and E = (kappa/2) |row x|^2 / A.
  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, int count, R (*rows)[max_vertices]) {
    const R scale = square_root(params.modulus / rest.area);
    for (int i = 0; i < count; ++i) rows[0][i] = scale * rest.laplacian[i];
    return 1;
  }
};

/// Mean curvature of the edges (Juelicher, J. Phys. II France 6 (1996) 1797): M = 1/4 sum over the vertex's edges of
/// length times signed angle.
struct EdgeCurvature {
  static constexpr const char* name = "juelicher_bending";

  /// Returns M (um); writes dM/dx.
  template <class T>
  NPFEM_HD static T mean_curvature(const Vec3<T>* x, int count, Vec3<T>* gradient) {
    T sum = T(0);
    for (int i = 0; i < count; ++i) gradient[i] = {T(0), T(0), T(0)};
    for (int i = 1; i < count; ++i) {
      const int next = next_in_ring(i, count), previous = previous_in_ring(i, count);
      const Vec3<T> hinge[4] = {x[0], x[i], x[next], x[previous]};
      const HingeAngle<T> angle = hinge_angle(hinge);
      const T theta = arc_tangent(angle.sine, angle.cosine);
      Vec3<T> slope[4];
      hinge_angle_gradient(hinge, angle, T(0.25f) * angle.edge_length, slope);
      const Vec3<T> along = (T(0.25f) * theta / larger(angle.edge_length, T(1e-30f))) * angle.edge;
      gradient[0] = gradient[0] + slope[0] - along;
      gradient[i] = gradient[i] + slope[1] + along;
      gradient[next] = gradient[next] + slope[2];
      gradient[previous] = gradient[previous] + slope[3];
      sum = sum + T(0.25f) * angle.edge_length * theta;
    }
    return sum;
  }
};

/// Mean curvature of the cotangent Laplacian (Meyer, Desbrun, Schroeder & Barr 2003): the slope G of the area of the
/// ring by its centre is the integral of 2 H n, and M = G . m / 2 with m the unit normal of the ring (the direction in
/// which the centre gains volume).
struct CotangentCurvature {
  static constexpr const char* name = "cotangent_bending";

  /// Returns M (um); writes dM/dx.
  template <class T>
  NPFEM_HD static T mean_curvature(const Vec3<T>* x, int count, Vec3<T>* gradient) {
    const T tiny = T(1e-30f), half = T(0.5f);
    Vec3<T> by_centre{T(0), T(0), T(0)}, volume_direction{T(0), T(0), T(0)};
    for (int i = 1; i < count; ++i) {
      const Vec3<T> a = x[i] - x[0], b = x[next_in_ring(i, count)] - x[0];
      const Vec3<T> normal = cross(a, b);
      by_centre = by_centre + (half / larger(norm(normal), tiny)) * cross(normal, b - a);
      volume_direction = volume_direction + normal;
      gradient[i] = {T(0), T(0), T(0)};
    }
    gradient[0] = {T(0), T(0), T(0)};
    const T per_length = T(1) / larger(norm(volume_direction), tiny);
    const Vec3<T> m = per_length * volume_direction;
    const T along = dot(by_centre, m);
    const Vec3<T> turn = (half * per_length) * (by_centre - along * m);  // dM/d(volume_direction)
    for (int i = 1; i < count; ++i) {
      const int j = next_in_ring(i, count);
      const Vec3<T> a = x[i] - x[0], b = x[j] - x[0];
      const Vec3<T> normal = cross(a, b);
      const T per_twice_area = T(1) / larger(norm(normal), tiny);
      const Vec3<T> unit = per_twice_area * normal;
      const Vec3<T> tilt = cross(b - a, m);
      const Vec3<T> by_normal = (T(0.25f) * per_twice_area) * (tilt - dot(tilt, unit) * unit) + turn;
      const Vec3<T> by_edge = T(0.25f) * cross(m, unit);  // dM/d(b - a) at fixed normals
      const Vec3<T> at_i = cross(b, by_normal) - by_edge, at_j = cross(by_normal, a) + by_edge;
      gradient[i] = gradient[i] + at_i;
      gradient[j] = gradient[j] + at_j;
      gradient[0] = gradient[0] - (at_i + at_j);
    }
    return half * along;
  }
};

}  // namespace npfem
