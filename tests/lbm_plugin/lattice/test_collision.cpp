// SPDX-License-Identifier: MPL-2.0
// Kinds of collision, precisions and viscosities against closed solutions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

constexpr int kHeight = 16;

// Steady flow along x between plates at rest, driven by a body force; velocity by iy.
std::vector<double> driven_channel(LatticeOptions options, int steps, int inside_below = 0) {
  SerialCommunicator self;
  Lattice lattice(self, Decomposition({8, kHeight, 4}, {true, false, true}, 1), flows::plates(1, kHeight, {}, {}),
                  options);
  lattice.nodes().for_each_fluid_node([&](int ix, int iy, int iz) {
    if (iy < inside_below) lattice.set_inside(ix, iy, iz);
  });
  for (int step = 0; step < steps; ++step) lattice.step();
  std::vector<double> velocity;
  for (int iy = 0; iy < kHeight; ++iy) velocity.push_back(lattice.node_velocity(3, iy, 2)[0]);
  return velocity;
}

double parabola(int iy, double tau, double force) {
  const double y = iy + 0.5;
  return force * y * (kHeight - y) / (2.0 * lattice_viscosity(tau));
}

TEST(Collision, SinglePrecisionIsAsGoodAsItsDigits) {
  const double force = 1e-5;
  LatticeOptions options{.tau = 0.9, .body_force = {force, 0, 0}};
  options.precision = FluidPrecision::single_precision;
  for (const bool node_force : {false, true}) {
    options.node_force = node_force;
    const auto velocity = driven_channel(options, 4000);
    const double largest = parabola(kHeight / 2, 0.9, force);
    for (int iy = 0; iy < kHeight; ++iy) {
      EXPECT_NEAR(velocity[std::size_t(iy)], parabola(iy, 0.9, force), 2e-5 * largest) << iy;
    }
  }
}

TEST(Collision, TheBodyForceAloneNeedsNoForceAtNodes) {
  LatticeOptions options{.tau = 0.9, .body_force = {1e-5, 2e-5, 0}};
  const auto with = driven_channel(options, 500);
  options.node_force = false;
  EXPECT_EQ(driven_channel(options, 500), with);
}

// Regularised populations slip at half-way walls by (16/48 (tau - 1/2) - 3/16) force / nu as TRT with magic
// (tau - 1/2)/2 does: the odd part relaxes at once.
TEST(Collision, RegularisedHasTheViscosityAndWallOfItsOddRelaxation) {
  const double tau = 0.9, force = 1e-5;
  LatticeOptions options{.tau = tau, .body_force = {force, 0, 0}};
  options.collision = Collision::regularised;
  options.magic = 0.5 * (tau - 0.5);
  const auto regularised = driven_channel(options, 4000);
  const double slip = (16.0 * options.magic - 3.0) / 12.0 * force / (2.0 * lattice_viscosity(tau));
  for (int iy = 0; iy < kHeight; ++iy) {
    EXPECT_NEAR(regularised[std::size_t(iy)], parabola(iy, tau, force) + slip, 1e-8 * parabola(8, tau, force)) << iy;
  }
}

TEST(Collision, RegularisedDecaysATaylorGreenVortexAtItsViscosity) {
  SerialCommunicator self;
  constexpr int n = 32;
  const double k = 2 * std::numbers::pi / n, tau = 0.8;
  LatticeOptions options{.tau = tau};
  options.collision = Collision::regularised;
  options.magic = 0.5 * (tau - 0.5);
  Lattice lattice(self, Decomposition({n, n, 1}, {true, true, true}, 1), flows::periodic(), options);
  lattice.initialise([&](int ix, int iy, int) {
    return FluidState{0, {1e-3 * std::sin(k * ix) * std::cos(k * iy), -1e-3 * std::cos(k * ix) * std::sin(k * iy), 0}};
  });
  const auto amplitude = [&] { return lattice.node_velocity(n / 4, 0, 0)[0]; };
  for (int step = 0; step < 100; ++step) lattice.step();
  const double early = amplitude();
  for (int step = 0; step < 400; ++step) lattice.step();
  const double rate = std::log(early / amplitude()) / 400;
  EXPECT_NEAR(rate, 2 * k * k * lattice_viscosity(tau), 0.01 * rate);
}

// Two layers: the shear stress is continuous, so that the velocity is two parabolas meeting at the interface half-way
// between the nodes (Ginzburg 2007: exact for the even part, second order for the shape).
TEST(Collision, TwoViscositiesShareTheStress) {
  const double force = 1e-6, outer = 0.8, inner = 2.0;
  LatticeOptions options{.tau = outer, .body_force = {force, 0, 0}};
  options.inside_tau = inner;
  const auto velocity = driven_channel(options, 6000, kHeight / 2);
  const double low = lattice_viscosity(inner), high = lattice_viscosity(outer), h = kHeight / 2;
  // u_low = a y - f y^2 / (2 nu_low); u_high = b (H - y) - f (H - y)^2 / (2 nu_high); equal u and nu u' at y = h.
  const double b = (2 * force * h + force * h * h / 2 * (1 / high - 1 / low) * low / h) / (low + high);
  const double a = (2 * force * h - high * b) / low;
  for (int iy = 0; iy < kHeight; ++iy) {
    const double y = iy + 0.5, z = kHeight - y;
    const double expected = iy < h ? a * y - force * y * y / (2 * low) : b * z - force * z * z / (2 * high);
    EXPECT_NEAR(velocity[std::size_t(iy)], expected, 0.01 * force * h * h / high) << iy;
  }
}

}  // namespace
}  // namespace npfem::flow
