// SPDX-License-Identifier: MPL-2.0
#include "simulation/signal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

TEST(Signal, IsOneUnlessMadeOtherwise) {
  EXPECT_TRUE(Signal().is_constant());
  EXPECT_EQ(Signal().at(123), 1);
  EXPECT_EQ(Signal().largest(), 1);
}

TEST(Signal, Sine) {
  const Signal signal = Signal::sine(0.5, 2, 800, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(signal.at(0), 2.5);
  EXPECT_NEAR(signal.at(200), 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(signal.at(400), -1.5);
  EXPECT_EQ(signal.at(100), signal.at(100 + 800 * 1e9)) << "no drift over a billion periods";
  EXPECT_EQ(signal.largest(), 2.5);
  EXPECT_FALSE(signal.is_constant());
}

TEST(Signal, TableIsPeriodicAndPiecewiseLinear) {
  const Signal signal = Signal::table({{100, 1}, {300, 3}, {400, -4}}, 500);
  EXPECT_DOUBLE_EQ(signal.at(100), 1);
  EXPECT_DOUBLE_EQ(signal.at(150), 1.5);
  EXPECT_DOUBLE_EQ(signal.at(350), -0.5);
  EXPECT_DOUBLE_EQ(signal.at(450), -4 + 5 * 0.25) << "on to the first point of the next period";
  EXPECT_DOUBLE_EQ(signal.at(0), -4 + 5 * 0.5);
  EXPECT_DOUBLE_EQ(signal.at(50), -4 + 5 * 0.75);
  EXPECT_EQ(signal.at(150), signal.at(5150));
  EXPECT_EQ(signal.largest(), 4);
}

/// Pulsating flow between plates that starts from rest: the momentum of the fluid is the impulse of force and walls.
TEST(Waveform, DrivesTheFluidAndTheMomentumIsAccountedFor) {
  flow::Setup setup = capsules::fluid(DomainKind::plates, {4, 16, 4}, 0.8);
  setup.body_force = {1e-3, 0, 0};
  const double period = 40 * setup.time_step;
  setup.waveform = Signal::sine(0, 1, period, 0);
  SerialCommunicator self;
  Simulation pulsating(setup, self);
  double forward = 0, backward = 0;
  for (int n = 0; n < 80; ++n) {
    pulsating.step();
    const double momentum = pulsating.lattice().momentum()[0];
    forward = std::max(forward, momentum);
    backward = std::min(backward, momentum);
  }
  EXPECT_LT(pulsating.momentum_error(), 1e-12);
  EXPECT_GT(forward, 0);
  EXPECT_LT(backward, 0) << "the flow turns";
  setup.waveform = Signal::sine(1, 0, period, 0);
  Simulation same(setup, self);
  setup.waveform = {};
  Simulation steady(setup, self);
  for (int n = 0; n < 50; ++n) {
    same.step();
    steady.step();
  }
  EXPECT_EQ(same.state_hash(), steady.state_hash()) << "a waveform of 1 changes nothing";
}

/// Womersley's flow between plates: amplitude and phase of the middle against the analytic solution.
TEST(Waveform, OscillatingFlowBetweenPlatesFollowsTheAnalyticSolution) {
  flow::Setup setup = capsules::fluid(DomainKind::plates, {1, 32, 1}, 0.8);
  setup.body_force = {1e-5, 0, 0};
  const double height = setup.domain.size()[1];
  const double nu = setup.kinematic_viscosity;
  const int steps_per_period = 4000;
  const double period = steps_per_period * setup.time_step;
  const double omega = 2 * std::numbers::pi / period;
  setup.waveform = Signal::sine(0, 1, period, 0);
  SerialCommunicator self;
  Simulation simulation(setup, self);
  // u = Im[ f/(i omega rho) (1 - cosh(k (y - H/2))/cosh(k H/2)) exp(i omega t) ], k^2 = i omega/nu
  const std::complex<double> i(0, 1);
  const auto analytic = [&](double y, double t) {
    const std::complex<double> k = std::sqrt(i * omega / nu);
    const std::complex<double> shape = 1.0 - std::cosh(k * (y - 0.5 * height)) / std::cosh(0.5 * k * height);
    return std::imag(setup.body_force[0] / (i * omega * setup.density) * shape * std::exp(i * omega * t));
  };
  for (int n = 0; n < 3 * steps_per_period; ++n) simulation.step();
  double worst = 0, largest = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int n = 0; n < steps_per_period / 4; ++n) simulation.step();
    const double mean = simulation.lattice().momentum()[0] * simulation.units().impulse() /
                        (setup.density * height * setup.domain.dx * setup.domain.dx);
    double exact = 0;
    for (int j = 0; j < 32; ++j) exact += analytic((j + 0.5) / 32 * height, simulation.time_us()) / 32;
    worst = std::max(worst, std::abs(mean - exact));
    largest = std::max(largest, std::abs(exact));
  }
  EXPECT_LT(worst, 0.005 * largest);
}

}  // namespace
}  // namespace npfem::flow
