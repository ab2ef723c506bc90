// SPDX-License-Identifier: MPL-2.0
#include "lattice/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

const std::array<bool, 3> kPeriodic{true, true, true};

TEST(Lattice, StartsWithTheStateAskedFor) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({5, 4, 3}, kPeriodic, 1), flows::periodic(),
                  {0.8, 3.0 / 16.0, {0.01, -0.02, 0.03}});
  lattice.initialise([](int ix, int iy, int iz) { return FluidState{0.01 * ix, {0.01 * iy, 0.01 * iz, 0.01 * ix}}; });
  for (int iz = -2; iz < 5; ++iz) {  // halo included
    for (int iy = -2; iy < 6; ++iy) {
      for (int ix = -2; ix < 7; ++ix) {
        const Vec3 velocity = lattice.velocity_at(ix, iy, iz);
        EXPECT_NEAR(velocity[0], 0.01 * ((iy + 4) % 4), 1e-16);
        EXPECT_NEAR(velocity[1], 0.01 * ((iz + 3) % 3), 1e-16);
        EXPECT_NEAR(velocity[2], 0.01 * ((ix + 5) % 5), 1e-16);
      }
    }
  }
  EXPECT_NEAR(lattice.density_deviation(3, 1, 2), 0.03, 1e-16);
  EXPECT_NEAR(lattice.max_speed(), 0.01 * std::hypot(3.0, 2.0, 4.0), 1e-15);
  EXPECT_NEAR(lattice.mass_deviation(), 0.01 * 10 * 12, 1e-14);
}

TEST(Lattice, BodyForceAcceleratesUniformly) {
  SerialCommunicator communicator;
  const Vec3 force{1e-5, -2e-5, 3e-5};
  Lattice lattice(communicator, Decomposition({4, 4, 4}, kPeriodic, 1), flows::periodic(), {0.8, 3.0 / 16.0, force});
  for (int step = 0; step < 100; ++step) lattice.step();
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(lattice.node_velocity(1, 2, 3)[a], 100 * force[a], 1e-17);
  lattice.set_body_force({});
  lattice.clear_force();
  lattice.step();
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(lattice.node_velocity(1, 2, 3)[a], 99.5 * force[a], 1e-17);
}

TEST(Lattice, UniformAccelerationIsNoStrain) {
  SerialCommunicator communicator;
  const double force = 1e-6;
  Lattice lattice(communicator, Decomposition({4, 4, 4}, kPeriodic, 1), flows::periodic(),
                  {0.8, 3.0 / 16.0, {force, -force, 0.5 * force}});
  lattice.initialise([](int, int, int) { return FluidState{0.0, {0.05, 0.02, -0.03}}; });
  for (int step = 0; step < 100; ++step) lattice.step();
  // Left is the change of the force term in one step, of the order of the force squared; the term itself is 0.05 force.
  for (const double strain : lattice.strain_rate(1, 2, 3)) EXPECT_NEAR(strain, 0.0, 10.0 * force * force);
}

TEST(Lattice, EveryOptionMatters) {
  SerialCommunicator communicator;
  const auto hash = [&](const LatticeOptions& options) {
    Lattice lattice(communicator, Decomposition({4, 4, 4}, kPeriodic, 1), flows::periodic(), options);
    lattice.initialise([](int ix, int, int iz) { return FluidState{0.01 * iz, {0.0, 0.01 * ix, 0.0}}; });
    for (int step = 0; step < 2; ++step) lattice.step();  // the first collision starts from equilibrium
    return lattice.state_hash();
  };
  const std::uint64_t base = hash({0.8, 3.0 / 16.0, {}});
  EXPECT_EQ(hash({0.8, 3.0 / 16.0, {}}), base);
  EXPECT_NE(hash({0.9, 3.0 / 16.0, {}}), base);
  EXPECT_NE(hash({0.8, 1.0 / 4.0, {}}), base);
  EXPECT_NE(hash({0.8, 3.0 / 16.0, {1e-9, 0.0, 0.0}}), base);
}

TEST(Lattice, HashSeesOneBitAndThePlaceOfAValue) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({4, 4, 4}, kPeriodic, 1), flows::periodic(), {});
  const std::uint64_t rest = lattice.state_hash();
  Lattice::Populations none{}, one{};
  one[3] = std::numeric_limits<double>::denorm_min();
  lattice.set_populations_at(1, 2, 3, one);
  const std::uint64_t changed = lattice.state_hash();
  EXPECT_NE(changed, rest);
  lattice.set_populations_at(1, 2, 3, none);
  lattice.set_populations_at(2, 1, 3, one);
  EXPECT_NE(lattice.state_hash(), changed);
  EXPECT_NE(lattice.state_hash(), rest);
  lattice.set_populations_at(2, 1, 3, none);
  EXPECT_EQ(lattice.state_hash(), rest);
}

TEST(Lattice, ABlownUpFluidShows) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({4, 4, 4}, kPeriodic, 1), flows::periodic(), {});
  EXPECT_TRUE(lattice.is_finite());
  Lattice::Populations populations{};
  populations[1] = std::numeric_limits<double>::quiet_NaN();
  lattice.set_populations_at(1, 2, 3, populations);
  lattice.update_velocity();
  EXPECT_EQ(lattice.max_speed(), std::numeric_limits<double>::infinity());
  lattice.step();
  EXPECT_FALSE(lattice.is_finite());
}

std::string refusal(const LatticeOptions& options, const Geometry& geometry = flows::periodic()) {
  SerialCommunicator communicator;
  try {
    const Lattice lattice(communicator, Decomposition({4, 4, 4}, kPeriodic, 1), geometry, options);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Lattice, RefusesNonsense) {
  EXPECT_EQ(refusal({0.5, 0.1875, {}}),
            "relaxation time tau = 0.500000; it must exceed 1/2, where the viscosity is zero");
  EXPECT_EQ(refusal({std::nan(""), 0.1875, {}}),
            "relaxation time tau = nan; it must exceed 1/2, where the viscosity is zero");
  EXPECT_EQ(refusal({1.0, 0.0, {}}), "magic parameter 0.000000; it must be positive");
  EXPECT_EQ(refusal({1.0, 0.1875, {0.0, std::nan(""), 0.0}}), "the body force is not finite");
  EXPECT_EQ(refusal({}, {[](int, int, int) { return wall(0); }, {npfem::flow::Boundary{}}}),
            "the geometry has no fluid node");
  EXPECT_EQ(refusal({}, {[](int, int, int) { return wall(0); }, {}}),
            "node (2, 2, 2) belongs to boundary 0, but there are 0 boundaries");
}

}  // namespace
}  // namespace npfem::flow
