// SPDX-License-Identifier: MPL-2.0
// Flow rate through a round tube, its wall a staircase of half-way links: Q = pi R^4 F / (8 nu) (Hagen-Poiseuille).

#include <gtest/gtest.h>

#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

constexpr double kPi = 3.14159265358979323846;

double relative_flow_rate(int diameter, double tau) {
  const double radius = 0.5 * diameter;
  const double force = 1e-7;
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({1, diameter, diameter}, {true, false, false}, 1),
                  flows::tube(diameter, radius), {tau, 3.0 / 16.0, {force, 0.0, 0.0}});
  const int steps = int(12.0 * radius * radius / (5.783 * lattice.viscosity()));  // slowest mode: Bessel zero 2.405^2
  for (int step = 0; step < steps; ++step) lattice.step();
  const double exact = kPi * std::pow(radius, 4) * force / (8.0 * lattice.viscosity());
  return lattice.momentum()[0] / exact;
}

TEST(Tube, CarriesTheFlowOfHagenAndPoiseuille) {
  const double coarse = relative_flow_rate(20, 0.8);
  const double fine = relative_flow_rate(40, 0.8);
  RecordProperty("flow_rate_20", std::to_string(coarse));
  RecordProperty("flow_rate_40", std::to_string(fine));
  EXPECT_NEAR(coarse, 1.0, 0.05);
  EXPECT_NEAR(fine, 1.0, 0.02);
}

TEST(Tube, FlowDoesNotDependOnTheRelaxationTime) {
  EXPECT_NEAR(relative_flow_rate(20, 2.0) / relative_flow_rate(20, 0.6), 1.0, 1e-4);
}

}  // namespace
}  // namespace npfem::flow
