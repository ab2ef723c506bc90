// SPDX-License-Identifier: MPL-2.0
// Shapes that points are drawn to: nothing on the shape, the known distance beside it.
#include <gtest/gtest.h>

#include <cmath>

#include "energies/energy_list.h"
#include "random_shape.h"

namespace npfem {
namespace {

using V = Vec3<double>;
constexpr double w = 30;  // pN/um

/// Energy of points in units of w/2: the squared distance to the shape. `rest` is their shape at rest.
template <class G, int n>
double squared_distance(const V (&x)[n], const V (&rest)[n], const typename G::template Params<double>& params) {
  V unused[n];
  return G::energy_gradient(x, n, G::rest(rest, n, params), params, unused) / (w / 2);
}
template <class Law, int n>
double squared_distance(const V (&x)[n]) {
  return squared_distance<FittedShape<Law>>(x, x, {w});
}

/// Turns and shifts points, so that no axis is special.
template <int n>
void move(V (&x)[n]) {
  for (V& p : x) p = testing::moved(p, {1, -2, 0.5}, 0.8, {3, 1, -7});
}

TEST(PlaneAndLine, AreLeftByTheHeightOfThePoints) {
  V square[4] = {{1, 0, 0.1}, {0, 1, -0.1}, {-1, 0, 0.1}, {0, -1, -0.1}};
  move(square);
  EXPECT_NEAR(squared_distance<PlaneShape>(square), 4 * 0.01, 1e-14);
  V zigzag[4] = {{-3, 0.1, 0}, {-1, -0.1, 0}, {1, -0.1, 0}, {3, 0.1, 0}};
  move(zigzag);
  EXPECT_NEAR(squared_distance<LineShape>(zigzag), 4 * 0.01, 1e-14);
  EXPECT_NEAR(squared_distance<PlaneShape>(zigzag), 0, 1e-14);
}

TEST(Circle, IsLeftByRadiusAndHeight) {
  V x[12];
  for (int i = 0; i < 12; ++i) {
    const double angle = M_PI * i / 6;
    x[i] = {2 * std::cos(angle), 2 * std::sin(angle), 0};
  }
  move(x);
  EXPECT_NEAR(squared_distance<CircleShape>(x), 0, 1e-14);
  for (int i = 0; i < 12; ++i) {  // radius 2 +- 0.1 and height +- 0.05, both without a moment
    const double angle = M_PI * i / 6, rho = 2 + (i % 2 ? 0.1 : -0.1), height = i % 4 < 2 ? 0.05 : -0.05;
    x[i] = {rho * std::cos(angle), rho * std::sin(angle), height};
  }
  move(x);
  EXPECT_NEAR(squared_distance<CircleShape>(x), 12 * (0.01 + 0.0025), 1e-12);
}

TEST(Circle, IsFoundFromAnArc) {
  // A centre far from the points' own.
  V x[6];
  for (int i = 0; i < 6; ++i) x[i] = {5 * std::cos(0.2 * i), 5 * std::sin(0.2 * i), 0};
  move(x);
  EXPECT_NEAR(squared_distance<CircleShape>(x), 0, 1e-14);
}

TEST(Sphere, IsLeftByTheRadius) {
  V x[6] = {{2.1, 0, 0}, {-2.1, 0, 0}, {0, 1.9, 0}, {0, -1.9, 0}, {0, 0, 2}, {0, 0, -2}};
  move(x);
  EXPECT_NEAR(squared_distance<SphereShape>(x), 4 * 0.01, 1e-13);
  V cap[6] = {{0, 0, 3}, {1, 0, std::sqrt(8)}, {-1, 0, std::sqrt(8)}, {0, 1, std::sqrt(8)}, {0, -2, std::sqrt(5)},
              {2, 2, 1}};
  move(cap);
  EXPECT_NEAR(squared_distance<SphereShape>(cap), 0, 1e-13);
}

TEST(Similarity, AllowsMotionTurnAndScaleWithinItsRange) {
  using G = FittedShape<SimilarityShape>;
  const V rest[5] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
  V x[5], flat_rest[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, flat[4];
  for (int i = 0; i < 5; ++i) x[i] = 1.5 * rest[i];
  for (int i = 0; i < 4; ++i) flat[i] = 1.5 * flat_rest[i];
  move(x);
  move(flat);
  EXPECT_NEAR((squared_distance<G>(x, rest, {w, 0.5, 2})), 0, 1e-13);
  EXPECT_NEAR((squared_distance<G>(flat, flat_rest, {w, 0.5, 2})), 0, 1e-13) << "in a plane";
  double square_sum = 0;
  V centre{0.4, 0.6, 0.8};
  for (const V& r : rest) square_sum += dot(r - centre, r - centre);
  EXPECT_NEAR((squared_distance<G>(x, rest, {w, 1, 1})), 0.25 * square_sum, 1e-12) << "a rigid body";
}

TEST(Quadrilateral, IsMeasuredByItsTwistAndItsSkew) {
  // Unit square with one corner lifted by h: |z|^2 = h^2/4. A rhombus of angle a is as far from a rectangle as two
  // vectors of length s from a right angle: 2 s^2 sin^2((90 - a)/2).
  V x[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}}, unused[4];
  move(x);
  const ParallelogramShape::Params<double> p{w};
  const RectangleShape::Params<double> r{w};
  EXPECT_NEAR(ParallelogramShape::energy_gradient(x, ParallelogramShape::rest(x, p), p, unused) / (w / 2), 0.01, 1e-14);
  const double s = 2, a = 70 * M_PI / 180;
  V rhombus[4] = {
      {0, 0, 0}, {s, 0, 0}, {s + s * std::cos(a), s * std::sin(a), 0}, {s * std::cos(a), s * std::sin(a), 0}};
  move(rhombus);
  EXPECT_NEAR(ParallelogramShape::energy_gradient(rhombus, ParallelogramShape::rest(x, p), p, unused), 0, 1e-12);
  EXPECT_NEAR(RectangleShape::energy_gradient(rhombus, RectangleShape::rest(x, r), r, unused) / (w / 2),
              2 * s * s * std::pow(std::sin(10 * M_PI / 180), 2), 1e-12);
}

TEST(Angle, IsFreeWithinItsRangeAndTurnsBothVectors) {
  // Two unit vectors that miss the range by D turn by D/2 each: 2 sin^2(D/2) together.
  const AngleRange::Params<double> p{w, std::cos(M_PI / 3), std::cos(M_PI / 2)};  // 60 to 90 degrees
  const auto at = [&p](double degrees) {
    const double a = degrees * M_PI / 180;
    V x[3] = {{0, 0, 0}, {1, 0, 0}, {std::cos(a), std::sin(a), 0}}, unused[3];
    move(x);
    return AngleRange::energy_gradient(x, AngleRange::rest(x, p), p, unused) / (w / 2);
  };
  EXPECT_NEAR(at(75), 0, 1e-15);
  EXPECT_NEAR(at(40), 2 * std::pow(std::sin(10 * M_PI / 180), 2), 1e-13);
  EXPECT_NEAR(at(130), 2 * std::pow(std::sin(20 * M_PI / 180), 2), 1e-13);
}

TEST(Laplacian, RemembersALengthOrFlattens) {
  V x[5] = {{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, lifted[5];
  std::copy_n(x, 5, lifted);
  lifted[0].z = 0.7;
  EXPECT_NEAR((squared_distance<Laplacian>(lifted, x, {w, 0})), 0.04, 1e-14);
  EXPECT_NEAR((squared_distance<Laplacian>(lifted, x, {w, 1})), 0.49, 1e-14);
}

}  // namespace
}  // namespace npfem
