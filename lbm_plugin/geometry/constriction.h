// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "geometry/wall_distance.h"

namespace npfem::flow {

/// A smooth narrowing of a tube or of the space between plates, like a stenosis. The wall stands at
///
///   h(s) = wide - (wide - narrow) (1 + cos(2 pi s / length)) / 2  for |s| < length/2,  h(s) = wide beyond,
///
/// from the axis of the tube (or the plane midway between the plates), s along the flow from the throat.
class Constriction {
 public:
  struct Shape {
    int along;            ///< axis of the flow
    bool round;           ///< a tube; else plates across y
    Vec3 centre;          ///< of the throat, um
    double length;        ///< um
    double wide, narrow;  ///< radius, or half the distance of the plates, outside and in the throat, um
  };
  explicit Constriction(const Shape& shape);

  const Vec3& centre() const { return shape_.centre; }
  WallDistance distance(const Vec3& position) const;

 private:
  struct Foot {  // of the wall in a plane through the axis
    double s, h;
  };
  double height(double s) const;
  double slope(double s) const;      // dh/ds
  double curvature(double s) const;  // d2h/ds2
  Foot foot_of(double s, double h) const;

  Shape shape_;
  double steepest_;         // largest |dh/ds|
  std::vector<Foot> wall_;  // points along the wall, to start the search for the nearest one from
};

}  // namespace npfem::flow
