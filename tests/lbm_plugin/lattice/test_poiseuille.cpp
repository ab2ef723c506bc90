// SPDX-License-Identifier: MPL-2.0
// Flow between plates at rest, driven by a body force. With half-way walls the discrete solution is known in closed
// form: the parabola shifted by a uniform slip F/(2 nu) (16 magic - 3)/12 (Ginzburg & d'Humieres 2003), zero for
// magic = 3/16. Speeds are small because the quadratic terms of the equilibrium change u by a part u^2.

#include <gtest/gtest.h>

#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTopSpeed = 1e-5;

double force_for(double tau, int height) {
  return 8.0 * lattice_viscosity(tau) * kTopSpeed / (height * height);
}

double parabola(double tau, int height, int iy) {
  const double y = iy + 0.5;
  return force_for(tau, height) / (2.0 * lattice_viscosity(tau)) * y * (height - y);
}

// From rest until the slowest mode, exp(-nu pi^2 t / H^2), has lost 11 digits.
Lattice developed_flow(Communicator& communicator, double tau, double magic, int height) {
  LatticeOptions options{tau, magic, {force_for(tau, height), 0.0, 0.0}};
  const Decomposition split({1, height, 1}, {true, false, true}, 1);
  Lattice lattice(communicator, split, flows::plates(1, height, {}, {}), options);
  const int steps = int(25.0 * height * height / (lattice_viscosity(tau) * kPi * kPi)) + 200;
  for (int step = 0; step < steps; ++step) lattice.step();
  return lattice;
}

struct Case {
  double tau;
  int height;
};

class Poiseuille : public testing::TestWithParam<Case> {};

TEST_P(Poiseuille, IsExactWithTwoRelaxationTimes) {
  const auto [tau, height] = GetParam();
  SerialCommunicator communicator;
  const Lattice lattice = developed_flow(communicator, tau, 3.0 / 16.0, height);
  for (int iy = 0; iy < height; ++iy) {
    EXPECT_NEAR(lattice.node_velocity(0, iy, 0)[0], parabola(tau, height, iy), 1e-8 * kTopSpeed);
    EXPECT_NEAR(lattice.node_velocity(0, iy, 0)[1], 0.0, 1e-8 * kTopSpeed);
  }
}

TEST_P(Poiseuille, SlipsAsPredictedWithOneRelaxationTime) {
  const auto [tau, height] = GetParam();
  SerialCommunicator communicator;
  const double magic = bgk_magic(tau);
  const Lattice lattice = developed_flow(communicator, tau, magic, height);
  const double slip = force_for(tau, height) / (2.0 * lattice_viscosity(tau)) * (16.0 * magic - 3.0) / 12.0;
  for (int iy = 0; iy < height; ++iy) {
    EXPECT_NEAR(lattice.node_velocity(0, iy, 0)[0], parabola(tau, height, iy) + slip, 1e-6 * kTopSpeed);
  }
}

// The strain rate is known at each node by itself: du/dy / 2.
TEST_P(Poiseuille, StrainRateIsExact) {
  const auto [tau, height] = GetParam();
  SerialCommunicator communicator;
  const Lattice lattice = developed_flow(communicator, tau, 3.0 / 16.0, height);
  for (int iy = 0; iy < height; ++iy) {
    const double slope = force_for(tau, height) / lattice_viscosity(tau) * (0.5 * height - (iy + 0.5));
    const SymmetricTensor strain = lattice.strain_rate(0, iy, 0);
    EXPECT_NEAR(strain[3], 0.5 * slope, 1e-8 * kTopSpeed);
    // The others are not driven, up to the quadratic terms of the equilibrium.
    for (const std::size_t zero : {0, 1, 2, 4, 5}) EXPECT_NEAR(strain[zero], 0.0, 1e-4 * kTopSpeed);
  }
}

INSTANTIATE_TEST_SUITE_P(Channels, Poiseuille,
                         testing::Values(Case{0.55, 8}, Case{0.6, 8}, Case{1.0, 8}, Case{2.0, 8}, Case{0.55, 16},
                                         Case{0.6, 16}, Case{1.0, 16}, Case{2.0, 16}));

}  // namespace
}  // namespace npfem::flow
