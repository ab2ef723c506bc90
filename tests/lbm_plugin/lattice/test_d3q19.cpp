// SPDX-License-Identifier: MPL-2.0
#include "lattice/d3q19.h"

#include <gtest/gtest.h>

namespace npfem::flow::d3q19 {
namespace {

TEST(D3Q19, DirectionsComeInOppositePairs) {
  for (int i = 0; i < kDirections; ++i) {
    EXPECT_EQ(opposite(opposite(i)), i);
    EXPECT_EQ(weight(opposite(i)), weight(i));
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_EQ(kVelocity[std::size_t(opposite(i))][a], -kVelocity[std::size_t(i)][a]);
    }
  }
}

// The moments that make the lattice a fluid: isotropic up to fourth order, sound speed squared 1/3.
TEST(D3Q19, WeightsAreIsotropic) {
  const auto delta = [](std::size_t a, std::size_t b) { return a == b ? 1.0 : 0.0; };
  double total = 0.0;
  for (int i = 0; i < kDirections; ++i) total += weight(i);
  EXPECT_NEAR(total, 1.0, 1e-15);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      double second = 0.0;
      for (int i = 0; i < kDirections; ++i) {
        const auto& c = kVelocity[std::size_t(i)];
        second += weight(i) * c[a] * c[b];
      }
      EXPECT_NEAR(second, delta(a, b) / 3.0, 1e-15);
      for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t e = 0; e < 3; ++e) {
          double fourth = 0.0;
          for (int i = 0; i < kDirections; ++i) {
            const auto& c = kVelocity[std::size_t(i)];
            fourth += weight(i) * c[a] * c[b] * c[d] * c[e];
          }
          const double isotropic = delta(a, b) * delta(d, e) + delta(a, d) * delta(b, e) + delta(a, e) * delta(b, d);
          EXPECT_NEAR(fourth, isotropic / 9.0, 1e-15);
        }
      }
    }
  }
}

TEST(D3Q19, EquilibriumHasTheMomentsOfTheFluid) {
  const double drho = 0.013;
  const Vec3 u{0.02, -0.05, 0.03};
  double density = 0.0;
  Vec3 momentum{};
  std::array<Vec3, 3> flux{};
  for (int i = 0; i < kDirections; ++i) {
    const double f = equilibrium(i, drho, u);
    density += f;
    for (std::size_t a = 0; a < 3; ++a) {
      momentum[a] += kVelocity[std::size_t(i)][a] * f;
      for (std::size_t b = 0; b < 3; ++b) flux[a][b] += kVelocity[std::size_t(i)][a] * kVelocity[std::size_t(i)][b] * f;
    }
  }
  EXPECT_NEAR(density, drho, 1e-16);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(momentum[a], u[a], 1e-16);
    for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(flux[a][b], (a == b ? drho / 3.0 : 0.0) + u[a] * u[b], 1e-16);
  }
}

}  // namespace
}  // namespace npfem::flow::d3q19
