// SPDX-License-Identifier: MPL-2.0
// Membrane laws against closed forms: uniaxial tension of a patch (S1) and inflation of a sphere (S2).
// Source: Barthes-Biesel, Diaz & Dhenin, J. Fluid Mech. 460 (2002) 211, section 2.
#include <gtest/gtest.h>

#include <cmath>

#include "energies/energy_list.h"

namespace npfem {
namespace {

/// Principal tensions (per deformed length) of a law at stretches l1, l2, from forces on one triangle.
struct Tensions {
  double t1, t2;
};

template <class Law>
Tensions tensions(const typename Law::template Params<double>& params, double l1, double l2) {
  using E = Membrane<Law>;
  const Vec3<double> rest_shape[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Vec3<double> x[3] = {{0, 0, 0}, {l1, 0, 0}, {0, l2, 0}};
  Vec3<double> g[3];
  E::energy_gradient(x, E::rest(rest_shape, params), params, g);
  // dE/dx1 = A0 dW/dl1, and T1 = (dW/dl1) / l2; the shear parts must vanish.
  EXPECT_NEAR(g[1].y, 0, 1e-12);
  EXPECT_NEAR(g[2].x, 0, 1e-12);
  return {2 * g[1].x / l2, 2 * g[2].y / l1};
}

struct UniaxialPoint {
  double l1, nh, skalak1, skalak10, skalak100;
};
// T1/G_s with T2 = 0, computed from the closed forms of the laws (their eqs. 2.6 and 2.8).
constexpr UniaxialPoint uniaxial[] = {{1.1, .28691, .33270, .38757, .39648},
                                      {1.2, .55381, .74566, .83175, .84433},
                                      {1.5, 1.29279, 2.7873, 3.0241, 3.0558},
                                      {2.0, 2.47487, 11.255, 12.078, 12.176}};

double skalak_lateral_stretch(double c, double l1) {
  return std::sqrt((1 + c * l1 * l1) / (1 + c * std::pow(l1, 4)));
}

TEST(UniaxialTension, NeoHookean) {
  for (const auto& p : uniaxial) {
    const Tensions t = tensions<NeoHookean>({1.0}, p.l1, 1 / std::sqrt(p.l1));
    EXPECT_NEAR(t.t1, p.nh, 1e-5);
    EXPECT_NEAR(t.t2, 0, 1e-12);
  }
}

TEST(UniaxialTension, YeohIsTheNeoHookeanTimesItsSlope) {
  // W is a function of k alone, so the sheet narrows as a neo-Hookean one and T1 grows by (2/G_s) dW/dk.
  for (const auto& p : uniaxial) {
    const double k = p.l1 * p.l1 + 2 / p.l1 - 3;
    const Tensions t = tensions<Yeoh>({1.0, 0.1}, p.l1, 1 / std::sqrt(p.l1));
    EXPECT_NEAR(t.t1, p.nh * (1 + 0.6 * k * k), 2e-5 * (1 + 0.6 * k * k));
    EXPECT_NEAR(t.t2, 0, 1e-12);
  }
}

TEST(UniaxialTension, Skalak) {
  for (const auto& p : uniaxial) {
    const struct { double c, t1; } cases[] = {{1, p.skalak1}, {10, p.skalak10}, {100, p.skalak100}};
    for (const auto& k : cases) {
      const Tensions t = tensions<Skalak>({1.0, k.c}, p.l1, skalak_lateral_stretch(k.c, p.l1));
      EXPECT_NEAR(t.t1, k.t1, 1e-4 * k.t1);
      EXPECT_NEAR(t.t2, 0, 1e-11);
    }
  }
}

TEST(SphereInflation, PressureOfNeoHookeanAndSkalak) {
  // p R0/G_s = 2 T / (G_s l) at equal stretches.
  const struct {
    double l, nh, skalak1, skalak10;
  } points[] = {{1.05, .48340, .64780, 4.7209},
                {1.1, .79187, 1.40283, 10.592},
                {1.2, 1.10849, 3.3100, 26.50},
                {1.5, 1.21629, 13.854, 123.54}};
  for (const auto& p : points) {
    EXPECT_NEAR(2 * tensions<NeoHookean>({1.0}, p.l, p.l).t1 / p.l, p.nh, 2e-5);
    EXPECT_NEAR(2 * tensions<Skalak>({1.0, 1.0}, p.l, p.l).t1 / p.l, p.skalak1, 2e-4 * p.skalak1);
    EXPECT_NEAR(2 * tensions<Skalak>({1.0, 10.0}, p.l, p.l).t1 / p.l, p.skalak10, 3e-4 * p.skalak10);
  }
}

TEST(SphereInflation, NeoHookeanLimitPoint) {
  // p R0/G_s = 2 (1/l - 1/l^7) has its maximum at l = 7^(1/6).
  const double l = std::pow(7.0, 1.0 / 6);
  const auto pressure = [](double s) { return 2 * tensions<NeoHookean>({1.0}, s, s).t1 / s; };
  EXPECT_NEAR(pressure(l), 2 * (1 / l - std::pow(l, -7)), 1e-12);
  EXPECT_LT(pressure(l * 1.01), pressure(l));
  EXPECT_LT(pressure(l * 0.99), pressure(l));
}

TEST(SmallStrain, LineageShearModulusIsAQuarterOfLambda) {
  const double e = 1e-5;
  const Tensions t = tensions<LineageSurfaceMaterial>({35, 5, 27.5}, 1 + e, 1 / (1 + e));
  // Pure shear: T1 - T2 = 4 G_s e to first order.
  EXPECT_NEAR((t.t1 - t.t2) / (4 * e), 5.0 / 4, 1e-3);
}

TEST(SmallStrain, LineageAreaModulusIsHalfTheWeight) {
  const double e = 1e-6;
  const Tensions t = tensions<LineageArea>({5000, 1, 1}, 1 + e, 1 + e);
  EXPECT_NEAR(t.t1 / (2 * e), 2500, 0.1);
}

TEST(LocalArea, TensionIsTheModulusTimesTheStrainInAllDirections) {
  const Tensions t = tensions<LocalArea>({200}, 1.2, 1.1);
  EXPECT_NEAR(t.t1, 200 * (1.32 - 1), 1e-10);
  EXPECT_NEAR(t.t2, 200 * (1.32 - 1), 1e-10);
}

TEST(CollapseBarrier, ActsOnTrianglesThatVanishAndOnNoOthers) {
  const CollapseBarrier::Params<double> p{68};
  for (const double ratio : {0.4, 0.7, 1.0, 3.0}) {
    const auto w = CollapseBarrier::respond(2.0, ratio, p);
    EXPECT_EQ(w.energy, 0);
    EXPECT_EQ(w.by_area_ratio, 0);
  }
  // K (J0 - J)^3/J, and its slope by hand: -K (J0 - J)^2 (3 J + J0 - J)/J^2
  const auto w = CollapseBarrier::respond(2.0, 0.1, p);
  EXPECT_NEAR(w.energy, 68 * 0.027 / 0.1, 1e-12);
  EXPECT_NEAR(w.by_area_ratio, -68 * 0.09 * (0.3 + 0.3) / 0.01, 1e-10);
  EXPECT_EQ(w.by_square_sum, 0);
}

TEST(LineageArea, LeavesShearAloneAndProjectsExactly) {
  // Four Newton steps reach the nearest area-preserving stretches: the energy is that of the distance to them.
  const Tensions shear = tensions<LineageArea>({5000, 1, 1}, 1.3, 1 / 1.3);
  EXPECT_NEAR(shear.t1, 0, 1e-9);
  EXPECT_NEAR(shear.t2, 0, 1e-9);
  const auto w = LineageArea::respond(1.2 * 1.2 * 2.0, 1.2 * 1.2, LineageArea::Params<double>{5000, 1, 1});
  EXPECT_NEAR(w.energy, 0.5 * 5000 * 2 * 0.2 * 0.2, 1e-9);  // nearest is (1, 1)
}

}  // namespace
}  // namespace npfem
