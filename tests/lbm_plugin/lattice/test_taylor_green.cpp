// SPDX-License-Identifier: MPL-2.0
// A square array of decaying vortices, periodic in every direction, on one rank:
// u = U exp(-2 nu k^2 t) (-cos kx sin ky, sin kx cos ky), an exact solution of the Navier-Stokes equations.

#include <gtest/gtest.h>

#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

constexpr double kPi = 3.14159265358979323846;

Vec3 vortices(double k, double x, double y) {
  return {-std::cos(k * x) * std::sin(k * y), std::sin(k * x) * std::cos(k * y), 0.0};
}

Lattice vortex_lattice(Communicator& communicator, int n, double tau, double speed, const Vec3& drift) {
  const double k = 2.0 * kPi / n;
  Lattice lattice(communicator, Decomposition({n, n, 1}, {true, true, true}, 1), flows::periodic(),
                  {tau, 3.0 / 16.0, {}});
  lattice.initialise([&](int ix, int iy, int) {
    const Vec3 v = vortices(k, ix, iy);
    const double pressure = -0.25 * speed * speed * (std::cos(2.0 * k * ix) + std::cos(2.0 * k * iy));
    return FluidState{3.0 * pressure, {drift[0] + speed * v[0], drift[1] + speed * v[1], 0.0}};
  });
  return lattice;
}

double vortex_energy(const Lattice& lattice, const Vec3& drift) {
  double energy = 0.0;
  for (int iy = 0; iy < lattice.nodes().size(1); ++iy) {
    for (int ix = 0; ix < lattice.nodes().size(0); ++ix) {
      const Vec3 u = lattice.node_velocity(ix, iy, 0);
      energy += (u[0] - drift[0]) * (u[0] - drift[0]) + (u[1] - drift[1]) * (u[1] - drift[1]);
    }
  }
  return energy;
}

// Decay rate of the velocity divided by 2 nu k^2, over one e-folding after a first one for the start to settle.
double relative_decay_rate(int n, double tau, double speed, const Vec3& drift) {
  SerialCommunicator communicator;
  Lattice lattice = vortex_lattice(communicator, n, tau, speed, drift);
  const double k = 2.0 * kPi / n;
  const double rate = 2.0 * lattice.viscosity() * k * k;
  const int steps = int(1.0 / rate);
  for (int step = 0; step < steps; ++step) lattice.step();
  const double before = vortex_energy(lattice, drift);
  for (int step = 0; step < steps; ++step) lattice.step();
  return 0.5 * std::log(before / vortex_energy(lattice, drift)) / (steps * rate);
}

// Root mean square error relative to the exact solution after one e-folding; diffusive scaling: U ~ 1/N, tau fixed.
double relative_error(int n) {
  SerialCommunicator communicator;
  const double speed = 0.016 / n;
  Lattice lattice = vortex_lattice(communicator, n, 0.8, speed, {});
  const double k = 2.0 * kPi / n;
  const double rate = 2.0 * lattice.viscosity() * k * k;
  const int steps = int(std::lround(1.0 / rate));
  for (int step = 0; step < steps; ++step) lattice.step();
  double error = 0.0;
  double total = 0.0;
  for (int iy = 0; iy < n; ++iy) {
    for (int ix = 0; ix < n; ++ix) {
      const Vec3 u = lattice.node_velocity(ix, iy, 0);
      const Vec3 v = vortices(k, ix, iy);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double exact = speed * std::exp(-rate * steps) * v[axis];
        error += (u[axis] - exact) * (u[axis] - exact);
        total += exact * exact;
      }
    }
  }
  return std::sqrt(error / total);
}

TEST(TaylorGreen, ConvergesWithSecondOrder) {
  const double coarse = relative_error(16);
  const double middle = relative_error(32);
  const double fine = relative_error(64);
  RecordProperty("error_16", std::to_string(coarse));
  RecordProperty("error_32", std::to_string(middle));
  RecordProperty("error_64", std::to_string(fine));
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.1);
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.1);
}

TEST(TaylorGreen, DecaysWithTheViscosityAskedFor) {
  EXPECT_NEAR(relative_decay_rate(64, 0.6, 1e-3, {}), 1.0, 1e-3);
  EXPECT_NEAR(relative_decay_rate(64, 0.8, 1e-3, {}), 1.0, 1e-3);
}

// In time the lattice is a Maxwell fluid: stress follows the rate of strain with the delay T = tau - 1/2, so that a
// vortex of the Stokes rate R decays with the slower root of T s^2 - s + R = 0, and oscillates beyond 4 T R = 1.
TEST(TaylorGreen, FollowsTheTelegraphEquationAtLargeRelaxationTimes) {
  constexpr int n = 64;
  const double k = 2.0 * kPi / n;
  for (const double tau : {1.0, 2.0, 4.0}) {
    const double delay = tau - 0.5;
    const double stokes = 2.0 * lattice_viscosity(tau) * k * k;
    const double expected = (1.0 - std::sqrt(1.0 - 4.0 * delay * stokes)) / (2.0 * delay * stokes);
    EXPECT_NEAR(relative_decay_rate(n, tau, 1e-4, {}), expected, 0.006 * (expected - 1.0) + 6e-4) << tau;
  }
  SerialCommunicator communicator;
  Lattice lattice = vortex_lattice(communicator, n, 12.0, 1e-4, {});  // 4 T R = 3.4
  double least = 1.0;
  for (int step = 0; step < 120; ++step) {
    lattice.step();
    least = std::min(least, lattice.node_velocity(3 * n / 8, n / 8, 0)[0] / 1e-4);
  }
  EXPECT_LT(least, -0.02);
}

// Vortices carried along by a uniform stream decay as those at rest, up to the cubic velocity error of the lattice.
TEST(TaylorGreen, DecaysAlikeInAMovingFrame) {
  const double at_rest = relative_decay_rate(32, 0.8, 1e-3, {});
  EXPECT_NEAR(relative_decay_rate(32, 0.8, 1e-3, {0.05, 0.0, 0.0}) / at_rest, 1.0, 0.01);
  EXPECT_NEAR(relative_decay_rate(32, 0.8, 1e-3, {0.03, -0.04, 0.0}) / at_rest, 1.0, 0.01);
}

}  // namespace
}  // namespace npfem::flow
