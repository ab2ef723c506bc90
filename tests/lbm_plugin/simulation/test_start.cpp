// SPDX-License-Identifier: MPL-2.0
#include "simulation/start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

/// Largest change of the velocity over some steps from the developed start, over the largest velocity.
double drift_from(flow::Setup setup, int steps) {
  setup.start_developed = true;
  SerialCommunicator self;
  Simulation simulation(setup, self);
  const auto fluid_velocity = [&](int ix, int iy) {
    return simulation.lattice().node_type(ix, iy, 1) == kFluid ? simulation.lattice().node_velocity(ix, iy, 1) : Vec3{};
  };
  std::vector<Vec3> before;
  const auto& nodes = setup.domain.nodes;
  for (int iy = 0; iy < nodes[1]; ++iy) {
    for (int ix = 0; ix < nodes[0]; ++ix) before.push_back(fluid_velocity(ix, iy));
  }
  for (int i = 0; i < steps; ++i) simulation.step();
  double largest = 0, change = 0;
  std::size_t n = 0;
  for (int iy = 0; iy < nodes[1]; ++iy) {
    for (int ix = 0; ix < nodes[0]; ++ix, ++n) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        largest = std::max(largest, std::abs(before[n][axis]));
        change = std::max(change, std::abs(fluid_velocity(ix, iy)[axis] - before[n][axis]));
      }
    }
  }
  return change / largest;
}

TEST(DevelopedStart, IsSteadyBetweenPlates) {
  flow::Setup setup = capsules::fluid(DomainKind::plates, {4, 16, 4}, 1.0);
  setup.body_force = {1e-5, 0, 0};
  EXPECT_LT(drift_from(setup, 300), 1e-5);
}

TEST(DevelopedStart, IsSteadyInShear) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {4, 16, 4}, 1.0);
  setup.domain.plate_speed = 0.04;
  EXPECT_LT(drift_from(setup, 300), 1e-10);
}

// The staircase of the lattice is not round: within its first-order error.
TEST(DevelopedStart, IsNearlySteadyInATube) {
  flow::Setup setup = capsules::fluid(DomainKind::tube, {24, 24, 3}, 1.0);
  setup.body_force = {0, 0, 1e-5};
  EXPECT_LT(drift_from(setup, 300), 0.05);
}

TEST(DevelopedStart, IsPoiseuilleInATube) {
  flow::Setup setup = capsules::fluid(DomainKind::tube, {24, 24, 3}, 1.0);
  setup.body_force = {0, 0, 1e-5};
  EXPECT_NEAR(developed_velocity(setup, {12, 12, 1})[2], 1e-5 * 144 / (4.0 / 6.0), 1e-15);
  EXPECT_NEAR(developed_velocity(setup, {24, 12, 1})[2], 0, 1e-15);
}

TEST(RequireSound, NamesWhatIsWrong) {
  const auto message = [](const flow::Setup& setup) -> std::string {
    try {
      require_sound(setup);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  flow::Setup setup = capsules::fluid(DomainKind::plates, {4, 8, 4}, 1.0);
  EXPECT_EQ(message(setup), "");
  setup.coupling.steps_per_solve = 0;
  EXPECT_EQ(message(setup), "setup: steps_per_solve is 0; it must be at least 1");
  setup = capsules::fluid(DomainKind::plates, {4, 8, 4}, 1.0);
  setup.time_step = std::nan("");
  EXPECT_EQ(message(setup), "setup: time_step is nan us; it must be positive and finite");
  setup = capsules::fluid(DomainKind::plates, {4, 0, 4}, 1.0);
  EXPECT_EQ(message(setup), "setup: the domain has 0 nodes in one direction; at least 1 is needed");
}

}  // namespace
}  // namespace npfem::flow
