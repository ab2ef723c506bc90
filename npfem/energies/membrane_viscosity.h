// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/vec3.h"

namespace npfem {

/// The metric of a triangle: scalar products of its edges x1 - x0 and x2 - x0, um^2.
template <class T>
struct Metric {
  T m11, m12, m22;
};

/// metric(e + d) - metric(e) in terms of d, so that a small change keeps all its digits.
template <class T>
NPFEM_HD Metric<T> metric_change(const Vec3<T>& e1, const Vec3<T>& e2, const Vec3<T>& d1, const Vec3<T>& d2) {
  return {dot(e1 + e1 + d1, d1), dot(e1, d2) + dot(d1, e2 + d2), dot(e2 + e2 + d2, d2)};
}

/// det(m + change) - det(m). The determinant of a metric is four times the square of the area.
template <class T>
NPFEM_HD T determinant_change(const Metric<T>& m, const Metric<T>& change) {
  return m.m11 * change.m22 + change.m11 * (m.m22 + change.m22) - (m.m12 + m.m12 + change.m12) * change.m12;
}

/// Viscosity of a membrane in its own plane, the Kelvin-Voigt part of Evans & Hochmuth 1976 (Biophys. J. 16, 1):
/// tensions
///   T = 2 eta_s dev(r) + eta_d tr(r) 1,   r the rate of strain,
/// eta_s the shear and eta_d the dilatational surface viscosity (1 uN s/m = 1e6 pN us/um).
///
/// In a step that differences as dg/dt = (g - G)/h, g the metric at its end and G that of the known past, the energy
///   D = A_G { (eta_s/h) [t/(2J) - 1] + (eta_d/h) [y^2 + 2/y - 3]/6 },   t = tr(G^-1 g), J^2 = det(G^-1 g), y = A/A*
/// has just that tension at its end: the first term exactly, for any strain; the second to second order in y - 1.
/// Hence the dissipation does not depend on the time step beyond the order of the integrator.
/// With `past` = 0, implicit Euler: h = dt, G = g_n, A* = A_n. With `past` = 1/3, BDF2: h = 2 dt/3,
/// G = (4 g_n - g_{n-1})/3, A* = (4 A_n - A_{n-1})/3. Both terms are convex in shear and area and forbid a collapse.
///
/// All is written in displacements: without one there is no force at all, and round-off does not grow with eta/h.
struct MembraneViscosity {
  template <class R>
  struct Params {
    R shear, dilatational;  ///< eta_s and eta_d, pN us/um; in energy_gradient() divided by h (us)
  };

  /// A triangle at the start of a step.
  template <class T>
  struct Start {
    Vec3<T> e1, e2;     ///< edges at x_n, um
    Metric<T> lag;      ///< G - g_n, um^2
    Metric<T> inverse;  ///< G^-1, 1/um^2
    T metric_area;      ///< A_G, um^2
    T area;             ///< A_n, um^2
    T area_lag;         ///< A* - A_n, um^2
    T weighed_area;     ///< A_G; 0 where the triangle has collapsed and knows no strain, um^2
  };

  /// `x`: the triangle at x_n, `last_move`: x_n - x_{n-1}.
  /// A triangle that would lose three quarters of its area by going on as before starts from x_n alone.
  template <class T>
  NPFEM_HD static Start<T> start(const Vec3<T> (&x)[3], const Vec3<T> (&last_move)[3], const T& past) {
    const Vec3<T> e1 = x[1] - x[0], e2 = x[2] - x[0];
    const Vec3<T> p1 = last_move[1] - last_move[0], p2 = last_move[2] - last_move[0];
    const Vec3<T> normal = cross(e1, e2);
    const Metric<T> now{dot(e1, e1), dot(e1, e2), dot(e2, e2)};
    const T determinant = dot(normal, normal);
    const T trace = now.m11 + now.m22;
    const T floor = T(1e-10f) * trace * trace + T(1e-30f);
    const T sound = larger(determinant, floor);
    const T area = T(0.5f) * square_root(sound);

    const Metric<T> before = metric_change(e1, e2, -p1, -p2);  // g_{n-1} - g_n
    const T square_change = determinant_change(now, before);
    const T area_before = T(0.5f) * square_root(larger(sound + square_change, T(0.0f)));
    const T area_lag = past * T(-0.25f) * square_change / (area + area_before);
    const Metric<T> lag{-past * before.m11, -past * before.m12, -past * before.m22};
    const T going_on = sound + determinant_change(now, lag);

    const T few = T(0.25f) * area;
    const T trusted = select(going_on < T(0.0625f) * sound, T(0.0f), select(area + area_lag < few, T(0.0f), T(1.0f)));
    const T metric_square = select(trusted < T(0.5f), sound, going_on);
    const T metric_area = T(0.5f) * square_root(metric_square);
    const Metric<T> used{trusted * lag.m11, trusted * lag.m12, trusted * lag.m22};
    const T scale = T(1.0f) / metric_square;
    return {e1,
            e2,
            used,
            {scale * (now.m22 + used.m22), -scale * (now.m12 + used.m12), scale * (now.m11 + used.m11)},
            metric_area,
            area,
            trusted * area_lag,
            select(determinant < floor, T(0.0f), metric_area)};
  }

  /// Returns D (pN um) of the displacements `move` from x_n; writes dD/dx (pN).
  template <class T, class R>
  NPFEM_HD static T energy_gradient(const Vec3<T> (&move)[3], const Start<T>& start, const Params<R>& per_time,
                                    Vec3<T> (&gradient)[3]) {
    const Vec3<T> d1 = move[1] - move[0], d2 = move[2] - move[0];
    const Metric<T> was{dot(start.e1, start.e1), dot(start.e1, start.e2), dot(start.e2, start.e2)};
    const Metric<T> change = metric_change(start.e1, start.e2, d1, d2);
    const Metric<T> strain{change.m11 - start.lag.m11, change.m12 - start.lag.m12, change.m22 - start.lag.m22};

    // G^-1 g = 1 + b; the deviator of b is [deviator, b12; b21, -deviator].
    const Metric<T>& inverse = start.inverse;
    const T b11 = inverse.m11 * strain.m11 + inverse.m12 * strain.m12;
    const T b12 = inverse.m11 * strain.m12 + inverse.m12 * strain.m22;
    const T b21 = inverse.m12 * strain.m11 + inverse.m22 * strain.m12;
    const T b22 = inverse.m12 * strain.m12 + inverse.m22 * strain.m22;
    const T deviator = R(0.5) * (b11 - b22);
    const T shear_square = deviator * deviator + b12 * b21;  // ((l1^2 - l2^2)/2)^2, l the stretches from G to g

    // An area below a thousandth of the start counts as that, so that a collapsed triangle has a finite energy.
    const T square_change = determinant_change(was, change);
    const T square = larger(R(4) * start.area * start.area + square_change, R(4e-6) * start.area * start.area);
    const T area = R(0.5) * square_root(square);
    const T j = area / start.metric_area;
    const T expected = start.area + start.area_lag;
    const T excess = (R(0.25) * square_change / (area + start.area) - start.area_lag) / expected;  // y - 1
    const T y = area / expected;

    // dD/de_i = A_G (p e^1, e^2)_i, e^1 and e^2 the dual of the edges now.
    const T shear = per_time.shear / j;
    const T dilatation = per_time.dilatational * excess * (y * y + y + R(1)) / (R(3) * y);
    const Vec3<T> e1 = start.e1 + d1, e2 = start.e2 + d2;
    const T m12 = was.m12 + change.m12, scale = start.weighed_area / square;
    const Vec3<T> dual1 = scale * ((was.m22 + change.m22) * e1 - m12 * e2);
    const Vec3<T> dual2 = scale * ((was.m11 + change.m11) * e2 - m12 * e1);
    gradient[1] = (dilatation + shear * deviator) * dual1 + (shear * b12) * dual2;
    gradient[2] = (shear * b21) * dual1 + (dilatation - shear * deviator) * dual2;
    gradient[0] = -(gradient[1] + gradient[2]);
    const T square_sum = R(2) + b11 + b22;
    return start.weighed_area * (R(2) * shear * shear_square / (square_sum + R(2) * j) +
                                 per_time.dilatational * excess * excess * (y + R(2)) / (R(6) * y));
  }

  /// Modulus by which viscosity enters the quasi-Newton matrix, times h (pN us/um): the stiffness of a sheet with shear
  /// modulus eta_s/h and area modulus eta_d/h, eta_s + eta_d along the gradient of a displacement, eta_s across it and
  /// none out of the plane, in the mean over the three. The matrix knows no directions; the largest of them would
  /// slow down what happens along the normal.
  template <class R>
  static R stiffness(const Params<R>& p) {
    return (R(2) * p.shear + p.dilatational) / R(3);
  }
};

}  // namespace npfem
