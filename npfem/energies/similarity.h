// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/fitted_shape.h"
#include "energies/singular_values.h"

namespace npfem {

/// Points in the shape that they had at rest, moved, turned and scaled by a factor within [least, largest]; a factor of
/// exactly 1 is a rigid body. The best rotation is the nearest one to sum_i d_i r_i^T (Kabsch 1976; Umeyama 1991).
struct SimilarityShape {
  static constexpr const char* name = "similarity";

  template <class R>
  struct Params {
    R weight;          ///< w, pN/um
    R least, largest;  ///< factor, 1
  };
  template <class R>
  struct Rest {
    Vec3<R> shape[32];  ///< r, from the centre, um
    R square_sum;       ///< sum of |r|^2, um^2
  };

  template <class R>
  NPFEM_HD static Rest<R> rest(const Vec3<R>* d, int count, const Params<R>&) {
    Rest<R> rest;
    rest.square_sum = R(0);
    for (int i = 0; i < 32; ++i) {
      rest.shape[i] = i < count ? d[i] : Vec3<R>{R(0), R(0), R(0)};
      rest.square_sum += dot(rest.shape[i], rest.shape[i]);
    }
    return rest;
  }

  template <class T, class R>
  NPFEM_HD static T respond(const Vec3<T>* d, int count, const Rest<R>& rest, const Params<R>& p, Vec3<T>* gradient) {
    Matrix3<T> a;
    for (Vec3<T>& column : a.column) column = {T(R(0)), T(R(0)), T(R(0))};
    for (int i = 0; i < count; ++i) {
      a.column[0] = a.column[0] + rest.shape[i].x * d[i];
      a.column[1] = a.column[1] + rest.shape[i].y * d[i];
      a.column[2] = a.column[2] + rest.shape[i].z * d[i];
    }
    const SingularValues<T> s = singular_values(a);
    const T factor = clamp((s.value[0] + s.value[1] + s.value[2]) / rest.square_sum, T(p.least), T(p.largest));
    const T scales[3] = {factor, factor, factor};
    const Matrix3<T> turn = s.matrix(scales);
    T energy = T(R(0));
    for (int i = 0; i < count; ++i) {
      const Vec3<R>& r = rest.shape[i];
      const Vec3<T> gap = d[i] - (r.x * turn.column[0] + r.y * turn.column[1] + r.z * turn.column[2]);
      gradient[i] = p.weight * gap;
      energy = energy + R(0.5) * p.weight * dot(gap, gap);
    }
    return energy;
  }
};

}  // namespace npfem
