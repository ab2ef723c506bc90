// SPDX-License-Identifier: MPL-2.0
#include "contact/nearest_point.h"

namespace npfem::flow {

// By the region of the plane, corner, edge or face, into which the point projects (Ericson, Real-Time Collision
// Detection, 2005, section 5.1.5).
std::array<double, 3> nearest_on_triangle(const Vec3& p, const Corners& corner) {
  const auto& [a, b, c] = corner;
  const Vec3 ab = subtract(b, a), ac = subtract(c, a), ap = subtract(p, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = subtract(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 > 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const Vec3 cp = subtract(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 > 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double per_area = 1 / (va + vb + vc);
  const double v = vb * per_area, w = vc * per_area;
  return {1 - v - w, v, w};
}

}  // namespace npfem::flow
