// SPDX-License-Identifier: MPL-2.0
#include "coupling/ambient_mass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace npfem::flow {
namespace {

constexpr Units kUnits{0.5, 0.1, 1000.0};

TEST(AmbientLayer, IsThatOfTheKernelWhenTheFluidIsNotViscous) {
  EXPECT_NEAR(ambient_layer(4, kUnits, 0, 0.1), 0.5 * 8 / 3, 1e-15);
  EXPECT_NEAR(ambient_layer(3, kUnits, 0, 0.1), 1.0, 1e-15);
  EXPECT_NEAR(ambient_layer(2, kUnits, 0, 0.1), 0.64, 1e-15);
}

TEST(AmbientLayer, GrowsWithTheMomentumThatDiffusesInOneStep) {
  const double ell = ambient_layer(3, kUnits, 1.2, 0.4);
  EXPECT_NEAR(ell * ell, 1.0 + std::numbers::pi * 1.2 * 0.4, 1e-14);
}

TEST(AmbientMass, IsThatOfTheLayerOverTheAreaOfTheVertex) {
  const std::vector<double> areas{0.2, 0.3};
  const std::vector<double> masses = ambient_masses(areas, 4, kUnits, 1.0, 0.1);
  const double ell = ambient_layer(4, kUnits, 1.0, 0.1);
  EXPECT_NEAR(masses[0], 1000 * 0.2 * ell, 1e-10);
  EXPECT_NEAR(masses[1], 1000 * 0.3 * ell, 1e-10);
}

TEST(AmbientMass, OfAVertexThatActsAloneIsThatOfItsKernel) {
  const std::vector<double> areas{50.0};
  EXPECT_NEAR(ambient_masses(areas, 3, kUnits, 0, 0.1)[0], 1000.0, 1e-10);  // (2 dx)^3
}

// A red cell (G = 5.5 uN/m, a = 4 um) at dx = 0.5 um in plasma, tau = 12: kappa = 1e-4, hence ell = 2.07 um.
TEST(AmbientLayer, AgreesWithTheWorkedExample) {
  const Units coarse{0.5, 0.958, 1025.0};
  EXPECT_NEAR(coarse.relaxation_time(1.0), 12.0, 0.01);
  EXPECT_NEAR(ambient_layer(4, coarse, 1.0, 0.8), 2.07, 0.005);
}

}  // namespace
}  // namespace npfem::flow
