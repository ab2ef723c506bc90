// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/helfrich.h"

namespace npfem {

/// Helfrich's energy with the mean curvature of the cotangent Laplacian (Meyer, Desbrun, Schroeder & Barr 2003): the
/// slope G of the area of the ring by its centre is the integral of 2 H n. With m the unit normal of the ring (the
/// direction in which the centre gains volume), M = G . m / 2. What G has along the surface is no curvature, but a mesh
/// that is free to slide would hide curvature there, so it counts as well, from its length at rest:
///   E = 2 kappa (M - A H0)^2 / A + (kappa/2) (|G_t| - A tau)^2 / A,   G_t = G - 2 M m.
/// With a uniform H0 tau is zero, and at H0 = 0 the energy is (kappa/2) |G|^2 / A.
struct CotangentBending {
  static constexpr const char* name = "cotangent_bending";
  static constexpr int max_vertices = max_ring_vertices;
  static constexpr bool zero_at_rest = true;

  template <class R>
  using Params = HelfrichParams<R>;
  template <class R>
  struct Rest {
    R curvature;  ///< H0, 1/um
    R along;      ///< tau, 1/um
    HelfrichWeight<R> weight;
  };

  /// Sums over the triangles of a ring.
  template <class T>
  struct Slopes {
    Vec3<T> area;         ///< G: slope of the ring's area by its centre, um
    Vec3<T> unit_normal;  ///< m
    T per_length;         ///< 1 / (sum of twice the area vectors), 1/um^2
    T mean_curvature;     ///< M, um
    Vec3<T> along;        ///< G_t, um
    T along_length;       ///< um
  };

  template <class T>
  NPFEM_HD static Slopes<T> slopes(const Vec3<T>* x, int count) {
    const T tiny = T(1e-30f), half = T(0.5f);
    Vec3<T> area{T(0), T(0), T(0)}, volume{T(0), T(0), T(0)};
    for (int i = 1; i < count; ++i) {
      const Vec3<T> a = x[i] - x[0], b = x[next_in_ring(i, count)] - x[0];
      const Vec3<T> normal = cross(a, b);
      area = area + (half / larger(norm(normal), tiny)) * cross(normal, b - a);
      volume = volume + normal;
    }
    Slopes<T> s;
    s.area = area;
    s.per_length = T(1) / larger(norm(volume), tiny);
    s.unit_normal = s.per_length * volume;
    const T outward = dot(area, s.unit_normal);
    s.mean_curvature = half * outward;
    s.along = area - outward * s.unit_normal;
    s.along_length = norm(s.along);
    return s;
  }

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* x, int count, const Params<R>& params) {
    Vec3<R> unused[max_vertices];
    const R area = ring_area(x, count, unused);
    const Slopes<R> s = slopes(x, count);
    return {select(params.uniform > R(0), params.spontaneous_curvature, s.mean_curvature / area),
            select(params.uniform > R(0), R(0), s.along_length / area), helfrich_weight(x, count, area)};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T>* x, int count, const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T>* gradient) {
    // A vertex whose triangles have vanished keeps a trace of area: a finite energy.
    const T smallest = T(R(1e-3) * rest.weight.area), present = ring_area(x, count, gradient);
    const T area = larger(present, smallest);
    const Slopes<T> s = slopes(x, count);
    const T excess = s.mean_curvature / area - rest.curvature, slip = s.along_length / area - rest.along;  // 1/um
    const T by_area = select(present < smallest, T(R(0)),
                             R(-2) * params.modulus * excess * (excess + R(2) * rest.curvature) -
                                 R(0.5) * params.modulus * slip * (slip + R(2) * rest.along));
    const T by_mean = R(4) * params.modulus * excess;
    const T by_along = params.modulus * slip / larger(s.along_length, T(R(1e-30)));    // times G_t: along its length
    const Vec3<T> by_slope = (R(0.5) * by_mean) * s.unit_normal + by_along * s.along;  // dE/dG
    const Vec3<T> by_volume =
        (s.per_length * (R(0.5) * by_mean - R(2) * s.mean_curvature * by_along)) * s.along;  // dE/d(area vectors)
    for (int i = 0; i < count; ++i) gradient[i] = by_area * gradient[i];
    add_slope_gradient(x, count, by_slope, by_volume, gradient);
    return R(2) * params.modulus * area * (excess * excess + R(0.25) * slip * slip);
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, int count, R (*rows)[max_vertices]) {
    return rest.weight.rows(params.modulus, count, rows);
  }

 private:
  /// Adds by_slope . dG/dx + by_volume . d(sum of twice the area vectors)/dx.
  template <class T>
  NPFEM_HD static void add_slope_gradient(const Vec3<T>* x, int count, const Vec3<T>& by_slope,
                                          const Vec3<T>& by_volume, Vec3<T>* gradient) {
    const T tiny = T(1e-30f), half = T(0.5f);
    for (int i = 1; i < count; ++i) {
      const int j = next_in_ring(i, count);
      const Vec3<T> a = x[i] - x[0], b = x[j] - x[0];
      const Vec3<T> normal = cross(a, b);
      const T per_twice_area = T(1) / larger(norm(normal), tiny);
      const Vec3<T> unit = per_twice_area * normal;
      const Vec3<T> tilt = cross(b - a, by_slope);
      const Vec3<T> by_normal = (half * per_twice_area) * (tilt - dot(tilt, unit) * unit) + by_volume;
      const Vec3<T> by_edge = half * cross(by_slope, unit);  // by b - a at fixed normals
      const Vec3<T> at_i = cross(b, by_normal) - by_edge, at_j = cross(by_normal, a) + by_edge;
      gradient[i] = gradient[i] + at_i;
      gradient[j] = gradient[j] + at_j;
      gradient[0] = gradient[0] - (at_i + at_j);
    }
  }
};

}  // namespace npfem
