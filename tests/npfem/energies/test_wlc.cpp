// SPDX-License-Identifier: MPL-2.0
// The spectrin network on a regular triangular sheet: its moduli, and the published formula for them.
#include <gtest/gtest.h>

#include <cmath>

#include "energies/energy_list.h"

namespace npfem {
namespace {

using V = Vec3<double>;
constexpr double mu0 = 6.3;  // uN/m

/// Energy per area (pN/um) of a sheet of equilateral triangles of side `side` whose plane is mapped by
/// ((a, b), (0, c)). A unit cell holds one edge of each of three directions and the area sqrt(3)/2 side^2.
double sheet_energy(double side, double a, double b, double c) {
  double energy = 0;
  for (const double angle : {0.0, M_PI / 3, 2 * M_PI / 3}) {
    const double x = side * std::cos(angle), y = side * std::sin(angle);
    const V rest_edge[2] = {{0, 0, 0}, {x, y, 0}}, edge[2] = {{0, 0, 0}, {a * x + b * y, c * y, 0}};
    V unused[2];
    const WormLikeChain::Params<double> params{mu0, 1 / 2.2};
    energy += WormLikeChain::energy_gradient(edge, WormLikeChain::rest(rest_edge, params), params, unused);
  }
  return energy / (std::sqrt(3) / 2 * side * side);
}

TEST(WormLikeChain, SheetHasTheShearModulus) {
  // Simple shear g costs mu0 g^2/2 per area, pure shear (1 + e, 1/(1 + e)) costs 2 mu0 e^2, at any mesh size.
  for (const double side : {0.2, 0.5, 1.0}) {
    const double g = 1e-4, e = 1e-4;
    EXPECT_NEAR(2 * sheet_energy(side, 1, g, 1) / (g * g), mu0, 1e-3);
    EXPECT_NEAR(sheet_energy(side, 1 + e, 0, 1 / (1 + e)) / (2 * e * e), mu0, 2e-3);
  }
}

TEST(WormLikeChain, AreaModulusIsTwiceTheShearModulus) {
  const double e = 1e-4;  // area strain 2 e costs K (2 e)^2/2
  EXPECT_NEAR(sheet_energy(0.5, 1 + e, 0, 1 + e) / (2 * e * e), 2 * mu0, 5e-3);
}

TEST(WormLikeChain, WeighsAnEdgeWithItsStiffness) {
  // Springs k on equilateral triangles have the shear modulus (sqrt 3/4) k.
  const V edge[2] = {{0, 0, 0}, {0.4, 0, 0}};
  const WormLikeChain::Params<double> params{mu0, 1 / 2.2};
  double rows[1][2];
  WormLikeChain::weight_rows(WormLikeChain::rest(edge, params), params, rows);
  EXPECT_NEAR(rows[0][1] * rows[0][1], 4 / std::sqrt(3.0) * mu0, 1e-12);
}

TEST(WormLikeChain, HasTheForceOfThePublishedChain) {
  // Marko and Siggia's force of the chain less the repulsion, at 1.5 times the rest length.
  const V rest_edge[2] = {{0, 0, 0}, {0.5, 0, 0}}, edge[2] = {{0, 0, 0}, {0.75, 0, 0}};
  const WormLikeChain::Params<double> params{mu0, 1 / 2.2};
  const auto rest = WormLikeChain::rest(rest_edge, params);
  V g[2];
  WormLikeChain::energy_gradient(edge, rest, params, g);
  const double x = 0.75 / 1.1;
  EXPECT_NEAR(g[1].x, rest.chain_force * (1 / (4 * (1 - x) * (1 - x)) - 0.25 + x) - rest.repulsion / (0.75 * 0.75),
              1e-12);
  EXPECT_NEAR(rest.repulsion / 0.25, rest.chain_force * (1 / (4 * std::pow(1 - 1 / 2.2, 2)) - 0.25 + 1 / 2.2), 1e-12);
}

TEST(WormLikeChain, HardensAndStaysFiniteBeyondItsLength) {
  const V rest_edge[2] = {{0, 0, 0}, {0.5, 0, 0}};
  const WormLikeChain::Params<double> params{mu0, 1 / 2.2};
  const auto rest = WormLikeChain::rest(rest_edge, params);
  double before = -1e300;
  for (double length = 0.001; length < 3; length += 0.01) {
    const V edge[2] = {{0, 0, 0}, {length, 0, 0}};
    V g[2];
    EXPECT_TRUE(std::isfinite(WormLikeChain::energy_gradient(edge, rest, params, g)));
    EXPECT_GT(g[1].x, before) << "the force grows with the length, across both ends of the law";
    before = g[1].x;
  }
}

}  // namespace
}  // namespace npfem
