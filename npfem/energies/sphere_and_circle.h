// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/fitted_shape.h"

namespace npfem {

template <class T>
struct FittedSphere {
  Vec3<T> centre;  ///< um
  T radius;        ///< um
};

/// a^-1 b, with eigenvalues taken by their size and not below `least`.
template <class T>
NPFEM_HD Vec3<T> solve_bounded(const Symmetric3<T>& a, const Vec3<T>& b, const T& least) {
  const SymmetricEigen<T> e = symmetric_eigen(a);
  Vec3<T> x{T(0), T(0), T(0)};
  for (int k = 0; k < 3; ++k) x = x + (dot(e.vector[k], b) / larger(absolute(e.value[k]), least)) * e.vector[k];
  return x;
}

/// Sphere with the least sum of squared distances (rho_i - r)^2, rho_i = |d_i - c|. The start is the algebraic fit
/// (least squares of rho_i^2 - r^2, linear in the unknowns); then eight Newton steps on the centre, the radius being
/// the mean of rho. The centre stays in the plane through the origin with the given unit normal, so that points of that
/// plane are fitted by a circle; a normal of zero leaves it free.
template <class T>
NPFEM_HD FittedSphere<T> fit_sphere(const Vec3<T>* d, int count, const T& size_square, const Vec3<T>& normal) {
  const T zero = T(0), one = T(1), per_count = one / T(static_cast<float>(count));
  const T smallest = T(1e-6f) * square_root(size_square);
  Vec3<T> b{zero, zero, zero};
  for (int i = 0; i < count; ++i) b = b + (T(0.5f) * dot(d[i], d[i])) * d[i];
  FittedSphere<T> s{solve_bounded(second_moment(d, count), b, T(1e-4f) * size_square), zero};
  for (int iteration = 0; iteration <= 8; ++iteration) {
    Vec3<T> unit[32], mean{zero, zero, zero};
    T rho[32];
    s.centre = s.centre - dot(s.centre, normal) * normal;
    s.radius = zero;
    for (int i = 0; i < count; ++i) {
      const Vec3<T> spoke = d[i] - s.centre;
      rho[i] = larger(norm(spoke), smallest);
      unit[i] = (one / rho[i]) * spoke;
      mean = mean + per_count * unit[i];
      s.radius = s.radius + per_count * rho[i];
    }
    if (iteration == 8) break;
    // Slope and curvature of half the sum of squares by the centre.
    Vec3<T> downhill{zero, zero, zero};
    Symmetric3<T> a{zero, zero, zero, zero, zero, zero};
    for (int i = 0; i < count; ++i) {
      const Vec3<T>& u = unit[i];
      const T side = one - s.radius / rho[i], along = one - side;
      downhill = downhill + (rho[i] - s.radius) * u;
      a.xx = a.xx + side + along * u.x * u.x - mean.x * mean.x;
      a.xy = a.xy + along * u.x * u.y - mean.x * mean.y;
      a.xz = a.xz + along * u.x * u.z - mean.x * mean.z;
      a.yy = a.yy + side + along * u.y * u.y - mean.y * mean.y;
      a.yz = a.yz + along * u.y * u.z - mean.y * mean.z;
      a.zz = a.zz + side + along * u.z * u.z - mean.z * mean.z;
    }
    s.centre = s.centre + solve_bounded(a, downhill, T(1e-3f));
  }
  return s;
}

/// Points on a sphere of any radius.
struct SphereShape : SizedShape {
  static constexpr const char* name = "sphere";
  template <class T, class R>
  NPFEM_HD static T respond(const Vec3<T>* d, int count, const Rest<R>& rest, const Params<R>& p, Vec3<T>* gradient) {
    const FittedSphere<T> s = fit_sphere(d, count, T(rest.size_square), Vec3<T>{T(R(0)), T(R(0)), T(R(0))});
    T energy = T(R(0));
    for (int i = 0; i < count; ++i) {
      const Vec3<T> spoke = d[i] - s.centre;
      const T rho = norm(spoke), gap = rho - s.radius;
      gradient[i] = (p.weight * gap / larger(rho, T(R(1e-30)))) * spoke;
      energy = energy + R(0.5) * p.weight * gap * gap;
    }
    return energy;
  }
};

/// Points on a circle of any radius: first to the nearest plane, then in that plane to the nearest circle,
///   E = (w/2) sum_i [z_i^2 + (rho_i - r)^2],   z_i the height over the plane, rho_i the distance in it from the
///   centre.
struct CircleShape : SizedShape {
  static constexpr const char* name = "circle";
  template <class T, class R>
  NPFEM_HD static T respond(const Vec3<T>* d, int count, const Rest<R>& rest, const Params<R>& p, Vec3<T>* gradient) {
    const SymmetricEigen<T> e = symmetric_eigen(second_moment(d, count));
    const Vec3<T> normal = e.vector[2];
    Vec3<T> flat[32];
    for (int i = 0; i < count; ++i) flat[i] = d[i] - dot(d[i], normal) * normal;
    const FittedSphere<T> s = fit_sphere(flat, count, T(rest.size_square), normal);
    T energy = T(R(0));
    Vec3<T> by_normal{T(R(0)), T(R(0)), T(R(0))};  // tilting the plane changes the distances in it
    for (int i = 0; i < count; ++i) {
      const Vec3<T> spoke = flat[i] - s.centre;
      const T height = dot(d[i], normal), rho = norm(spoke), gap = rho - s.radius;
      const Vec3<T> pull = (p.weight * gap / larger(rho, T(R(1e-30)))) * spoke;
      gradient[i] = pull + (p.weight * height) * normal;
      by_normal = by_normal - height * pull;
      energy = energy + R(0.5) * p.weight * (height * height + gap * gap);
    }
    // The normal follows the points as the last eigenvector of their second moment does.
    const T least = T(R(1e-6) * rest.size_square);
    Vec3<T> tilt{T(R(0)), T(R(0)), T(R(0))};
    for (int k = 0; k < 2; ++k) {
      tilt = tilt - (dot(by_normal, e.vector[k]) / larger(e.value[k] - e.value[2], least)) * e.vector[k];
    }
    for (int i = 0; i < count; ++i) {
      gradient[i] = gradient[i] + dot(d[i], normal) * tilt + dot(d[i], tilt) * normal;
    }
    return energy;
  }
};

}  // namespace npfem
