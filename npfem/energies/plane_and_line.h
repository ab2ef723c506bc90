// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/fitted_shape.h"

namespace npfem {

/// Points on a plane: the nearest one holds their centre and the two directions in which they extend furthest.
struct PlaneShape : SizedShape {
  static constexpr const char* name = "plane";
  template <class T, class R>
  NPFEM_HD static T respond(const Vec3<T>* d, int count, const Rest<R>&, const Params<R>& p, Vec3<T>* gradient) {
    const Vec3<T> normal = symmetric_eigen(second_moment(d, count)).vector[2];
    T energy = T(R(0));
    for (int i = 0; i < count; ++i) {
      const T pull = p.weight * dot(d[i], normal);
      gradient[i] = pull * normal;
      energy = energy + R(0.5) * pull * dot(d[i], normal);
    }
    return energy;
  }
};

/// Points on a straight line: the nearest one holds their centre and the direction in which they extend furthest.
struct LineShape : SizedShape {
  static constexpr const char* name = "line";
  template <class T, class R>
  NPFEM_HD static T respond(const Vec3<T>* d, int count, const Rest<R>&, const Params<R>& p, Vec3<T>* gradient) {
    const Vec3<T> direction = symmetric_eigen(second_moment(d, count)).vector[0];
    T energy = T(R(0));
    for (int i = 0; i < count; ++i) {
      const Vec3<T> gap = d[i] - dot(d[i], direction) * direction;
      gradient[i] = p.weight * gap;
      energy = energy + R(0.5) * p.weight * dot(gap, gap);
    }
    return energy;
  }
};

}  // namespace npfem
