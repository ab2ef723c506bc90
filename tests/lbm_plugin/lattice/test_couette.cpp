// SPDX-License-Identifier: MPL-2.0
// Flow between plates that slide past each other: linear between the wall surfaces, half-way between nodes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWallSpeed = 1e-5;

struct Case {
  double tau;
  int normal;  // axis across the gap
  int flow;    // axis the walls move along
};

class Couette : public testing::TestWithParam<Case> {};

TEST_P(Couette, IsLinearInEveryOrientation) {
  const auto [tau, normal, flow] = GetParam();
  constexpr int kHeight = 8;
  Index3 nodes{1, 1, 1};
  std::array<bool, 3> periodic{true, true, true};
  nodes[std::size_t(normal)] = kHeight;
  periodic[std::size_t(normal)] = false;
  Vec3 low{}, high{};
  low[std::size_t(flow)] = -0.25 * kWallSpeed;
  high[std::size_t(flow)] = kWallSpeed;

  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition(nodes, periodic, 1), flows::plates(normal, kHeight, low, high),
                  {tau, 3.0 / 16.0, {}});
  const int steps = int(30.0 * kHeight * kHeight / (lattice.viscosity() * kPi * kPi)) + 200;
  for (int step = 0; step < steps; ++step) lattice.step();
  lattice.update_velocity();

  // The velocity field covers the walls too: the nodes beyond a face move with its wall.
  for (int i = -2; i < kHeight + 2; ++i) {
    Index3 node{0, 0, 0};
    node[std::size_t(normal)] = i;
    const double y = std::clamp((i + 0.5) / kHeight, 0.0, 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      const double expected = axis == flow ? kWallSpeed * (1.25 * y - 0.25) : 0.0;
      EXPECT_NEAR(lattice.velocity_at(node[0], node[1], node[2])[std::size_t(axis)], expected, 1e-10 * kWallSpeed)
          << "node " << i << " axis " << axis;
    }
  }
  // Force on the walls: stress times area, equal and opposite; none on the fluid as a whole.
  EXPECT_NEAR(lattice.wall_impulse()[std::size_t(flow)], 0.0, 1e-10 * kWallSpeed);
}

INSTANTIATE_TEST_SUITE_P(Gaps, Couette,
                         testing::Values(Case{0.55, 1, 0}, Case{0.6, 1, 0}, Case{1.0, 1, 0}, Case{2.0, 1, 0},
                                         Case{0.8, 1, 2}, Case{0.8, 0, 1}, Case{0.8, 0, 2}, Case{0.8, 2, 0},
                                         Case{0.8, 2, 1}));

}  // namespace
}  // namespace npfem::flow
