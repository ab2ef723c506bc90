// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/arc_tangent.h"
#include "energies/helfrich.h"
#include "energies/hinge.h"

namespace npfem {

/// Helfrich's energy with the mean curvature of the edges (Juelicher, J. Phys. II France 6 (1996) 1797):
/// M = 1/4 sum over the vertex's edges of length times signed angle.
struct JuelicherBending {
  static constexpr const char* name = "juelicher_bending";
  static constexpr int max_vertices = max_ring_vertices;
  static constexpr bool zero_at_rest = true;

  template <class R>
  using Params = HelfrichParams<R>;
  template <class R>
  struct Rest {
    R curvature;  ///< H0, 1/um
    HelfrichWeight<R> weight;
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* x, int count, const Params<R>& params) {
    Vec3<R> unused[max_vertices];
    const R area = ring_area(x, count, unused);
    const R own = mean_curvature(x, count, unused) / area;
    return {select(params.uniform > R(0), params.spontaneous_curvature, own), helfrich_weight(x, count, area)};
  }

  /// Returns E (pN um); writes dE/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T>* x, int count, const Rest<R>& rest, const Params<R>& params,
                                    Vec3<T>* gradient) {
    Vec3<T> area_gradient[max_vertices];
    // A vertex whose triangles have vanished keeps a trace of area: a finite energy.
    const T smallest = T(R(1e-3) * rest.weight.area), present = ring_area(x, count, area_gradient);
    const T area = larger(present, smallest);
    const T excess = mean_curvature(x, count, gradient) / area - rest.curvature;  // H - H0, 1/um
    const T by_integral = R(4) * params.modulus * excess;
    const T by_area =
        select(present < smallest, T(R(0)), R(-2) * params.modulus * excess * (excess + R(2) * rest.curvature));
    for (int i = 0; i < count; ++i) gradient[i] = by_integral * gradient[i] + by_area * area_gradient[i];
    return R(2) * params.modulus * area * excess * excess;
  }

  template <class R>
  static int weight_rows(const Rest<R>& rest, const Params<R>& params, int count, R (*rows)[max_vertices]) {
    return rest.weight.rows(params.modulus, count, rows);
  }

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

}  // namespace npfem
