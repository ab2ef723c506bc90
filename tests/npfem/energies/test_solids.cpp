// SPDX-License-Identifier: MPL-2.0
// Strain limits, as-rigid-as-possible and solids on deformations with known stretches.
#include <gtest/gtest.h>

#include <cmath>

#include "energies/energy_list.h"
#include "random_shape.h"

namespace npfem {
namespace {

using V = Vec3<double>;
using M = Matrix3<double>;

M diagonal(double a, double b, double c) {
  return {{{a, 0, 0}, {0, b, 0}, {0, 0, c}}};
}

template <class Law>
double density(const M& f, const typename Law::template Params<double>& params) {
  return Law::respond(f, params).energy;
}

double distance(const M& a, const M& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += norm(a.column[i] - b.column[i]);
  return sum;
}

TEST(SymmetricEigen, FindsTheAxesOfAKnownMatrix) {
  // Eigenvalues 5, 2, 2 about (1, 1, 1): two equal ones are no special case.
  const auto e = symmetric_eigen(Symmetric3<double>{3, 1, 1, 3, 1, 3});
  EXPECT_NEAR(e.value[0], 5, 1e-14);
  EXPECT_NEAR(e.value[1], 2, 1e-14);
  EXPECT_NEAR(e.value[2], 2, 1e-14);
  EXPECT_NEAR(std::abs(dot(e.vector[0], V{1, 1, 1})), std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(dot(e.vector[2], cross(e.vector[0], e.vector[1])), 1, 1e-14);
}

TEST(SingularValues, RebuildTheMatrixFromRotations) {
  testing::Random random(3);
  for (int k = 0; k < 200; ++k) {
    M f{{random.vector(1), random.vector(1), random.vector(1)}};
    if (k % 4 == 1) f.column[2] = f.column[0];                      // flat
    if (k % 4 == 2) f.column[1] = f.column[2] = 2.0 * f.column[0];  // a line
    if (k == 3) f = diagonal(0, 0, 0);
    const auto s = singular_values(f);
    // A value of zero is the root of a rounded square, and its direction is free.
    EXPECT_LT(distance(s.matrix(s.value), f), k % 4 == 0 ? 1e-13 : 3e-8) << k;
    EXPECT_NEAR(dot(s.left[2], cross(s.left[0], s.left[1])), 1, 1e-12);
    EXPECT_NEAR(dot(s.right[2], cross(s.right[0], s.right[1])), 1, 1e-12);
    EXPECT_GE(s.value[0], s.value[1]);
    EXPECT_GE(s.value[1] + 1e-7, std::abs(s.value[2]));
  }
}

TEST(SingularValues, AreNegativeWhereSpaceIsInsideOut) {
  EXPECT_NEAR(singular_values(diagonal(2, -0.5, 1)).value[2], -0.5, 1e-14);
  EXPECT_NEAR(singular_values(diagonal(-2, -0.5, 1)).value[2], 0.5, 1e-14);
}

TEST(Arap, IsTheDistanceToTheNearestRotation) {
  EXPECT_NEAR(density<TetrahedronArap>(diagonal(1.2, 0.7, 1.1), {10}), 5 * (0.04 + 0.09 + 0.01), 1e-13);
  EXPECT_NEAR(density<TetrahedronArap>(diagonal(1, 1, -0.5), {10}), 5 * 2.25, 1e-13) << "inverted";
  const auto flat = TriangleArap::respond(1.2 * 1.2 + 0.7 * 0.7, 1.2 * 0.7, TriangleArap::Params<double>{10});
  EXPECT_NEAR(flat.energy, 5 * (0.04 + 0.09), 1e-13);
}

TEST(StrainLimit, IsFreeWithinItsRange) {
  const TetrahedronStrainLimit::Params<double> solid{10, 0.9, 1.2};
  EXPECT_EQ(density<TetrahedronStrainLimit>(diagonal(1.19, 0.91, 1), solid), 0);
  EXPECT_NEAR(density<TetrahedronStrainLimit>(diagonal(1.5, 0.7, 1), solid), 5 * (0.09 + 0.04), 1e-13);
  EXPECT_NEAR(density<TetrahedronStrainLimit>(diagonal(1, 1, -0.3), solid), 5 * 1.44, 1e-13) << "inverted";
  const TriangleStrainLimit::Params<double> sheet{10, 0.9, 1.2};
  EXPECT_EQ(TriangleStrainLimit::respond(1.19 * 1.19 + 0.91 * 0.91, 1.19 * 0.91, sheet).energy, 0);
  EXPECT_NEAR(TriangleStrainLimit::respond(1.5 * 1.5 + 0.7 * 0.7, 1.5 * 0.7, sheet).energy, 5 * (0.09 + 0.04), 1e-13);
  const V rest_edge[2] = {{0, 0, 0}, {2, 0, 0}}, inside[2] = {{0, 0, 0}, {0, 2.3, 0}},
          long_edge[2] = {{0, 0, 0}, {0, 3, 0}};
  const EdgeStrainLimit::Params<double> edge{10, 0.9, 1.2};
  V g[2];
  const auto rest = EdgeStrainLimit::rest(rest_edge, edge);
  EXPECT_EQ(EdgeStrainLimit::energy_gradient(inside, rest, edge, g), 0);
  EXPECT_NEAR(EdgeStrainLimit::energy_gradient(long_edge, rest, edge, g), 0.5 * 10 * 2 * 0.09, 1e-13);
  EXPECT_NEAR(g[1].y, 10 * 0.3, 1e-13) << "w (s - 1.2)";
}

TEST(NeoHookeanSolid, HasItsModuliAtSmallStrain) {
  const NeoHookeanSolid::Params<double> p{100, 400};
  const double e = 1e-4;
  EXPECT_NEAR(density<NeoHookeanSolid>({{{1, 0, 0}, {e, 1, 0}, {0, 0, 1}}}, p) / (e * e), 100 / 2.0, 1e-2);
  EXPECT_NEAR(density<NeoHookeanSolid>(diagonal(1 + e, 1 + e, 1 + e), p) / (e * e), 9 * 400 / 2.0, 1);
  EXPECT_NEAR(density<NeoHookeanSolid>(diagonal(1 + e, 1, 1), p) / (e * e), NeoHookeanSolid::stiffness(p) / 2, 1e-1);
}

TEST(NeoHookeanSolid, DrawsAnInvertedElementBack) {
  const NeoHookeanSolid::Params<double> p{100, 400};
  double before = 1e300;
  for (double l = -1.5; l < 1; l += 0.1) {
    const auto w = NeoHookeanSolid::respond(diagonal(1, 1, l), p);
    EXPECT_LT(w.energy, before);
    EXPECT_LT(w.stress.column[2].z, 0);
    before = w.energy;
  }
}

TEST(TetrahedronVolume, LeavesShapeAloneAndProjectsExactly) {
  const TetrahedronVolume::Params<double> p{10, 1, 1};
  EXPECT_NEAR(density<TetrahedronVolume>(diagonal(1.3, 1 / 1.3, 1), p), 0, 1e-13);
  EXPECT_NEAR(density<TetrahedronVolume>(diagonal(1.1, 1.1, 1.1), p), 5 * 3 * 0.01, 1e-12);  // nearest: (1, 1, 1)
  EXPECT_EQ(density<TetrahedronVolume>(diagonal(1.2, 1.2, 1.2), {10, 0.5, 2}), 0);
}

TEST(Tetrahedron, ReproducesAHomogeneousStretch) {
  using E = Tetrahedron<TetrahedronArap>;
  const V rest_shape[4] = {{0.1, 0, 0.3}, {1, 0.2, 0}, {0, 1.5, 0.1}, {0.2, 0.4, 2}};
  V x[4], g[4];
  for (int i = 0; i < 4; ++i) x[i] = {1.2 * rest_shape[i].x, 0.9 * rest_shape[i].y, rest_shape[i].z};
  const auto rest = E::rest(rest_shape, {10});
  const double volume = std::abs(dot(rest_shape[1] - rest_shape[0],
                                     cross(rest_shape[2] - rest_shape[0], rest_shape[3] - rest_shape[0]))) /
                        6;
  EXPECT_NEAR(E::energy_gradient(x, rest, {10}, g), volume * 5 * (0.04 + 0.01), 1e-13);
}

TEST(Closeness, PullsLikeASpring) {
  const V target[1] = {{1, 2, 3}}, x[1] = {{1, 2, 3.5}};
  V g[1];
  EXPECT_NEAR(Closeness::energy_gradient(x, Closeness::rest(target, {8}), Closeness::Params<double>{8}, g), 1, 1e-15);
  EXPECT_EQ(g[0].z, 4);
  static_assert(!is_translation_invariant_energy<Closeness>);
  static_assert(is_translation_invariant_energy<EdgeStrainLimit>);
}

}  // namespace
}  // namespace npfem
