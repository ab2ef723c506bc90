// SPDX-License-Identifier: MPL-2.0
// Mass and momentum, step by step: what goes in is what the fluid then has.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

struct Audit {
  double worst_step = 0.0;     // defect of one step, relative to the sum of |F| in that step
  double whole_run = 0.0;      // defect of the sum, relative to the sum of |F| over all steps
  double mass = 0.0;           // change of mass per node
  double bare_momentum = 0.0;  // defect of j(t+1) - j(t) = F + W over the run, relative as above
};

double total_force(const Lattice& lattice) {
  double sum = 0.0;
  lattice.nodes().for_each_fluid_node([&](int ix, int iy, int iz) {
    const Vec3 force = lattice.force_at(ix, iy, iz);
    sum += std::hypot(force[0], force[1], force[2]);
  });
  return sum;
}

// Random forces, new ones every second step, held in between.
Audit audit(Lattice& lattice, int steps) {
  Audit result;
  Vec3 sum{}, bare_sum{};
  double forces = 0.0;
  const Vec3 start = lattice.momentum();
  const Vec3 bare_start = lattice.bare_momentum();
  const double mass = lattice.mass_deviation();
  for (int step = 0; step < steps; ++step) {
    const Vec3 before = lattice.momentum();
    const Vec3 force_before = lattice.fluid_force();
    if (step % 2 == 0) {
      lattice.update_velocity();
      lattice.clear_force();
      flows::add_random_force(lattice, step, 1e-4);
    }
    const Vec3 force = lattice.fluid_force();
    const double size = total_force(lattice);
    lattice.step();
    forces += size;
    const Vec3 after = lattice.momentum();
    for (std::size_t a = 0; a < 3; ++a) {
      const double impulse = lattice.wall_impulse()[a] + force[a] + 0.5 * (force[a] - force_before[a]);
      result.worst_step = std::max(result.worst_step, std::abs(after[a] - before[a] - impulse) / size);
      sum[a] += impulse;
      bare_sum[a] += lattice.wall_impulse()[a] + force[a];
    }
  }
  const Vec3 end = lattice.momentum();
  const Vec3 bare_end = lattice.bare_momentum();
  for (std::size_t a = 0; a < 3; ++a) {
    result.whole_run = std::max(result.whole_run, std::abs(end[a] - start[a] - sum[a]) / forces);
    result.bare_momentum = std::max(result.bare_momentum, std::abs(bare_end[a] - bare_start[a] - bare_sum[a]) / forces);
  }
  result.mass = std::abs(lattice.mass_deviation() - mass) / double(lattice.nodes().fluid_nodes());
  return result;
}

void initialise_randomly(Lattice& lattice) {
  const Decomposition& split = lattice.decomposition();
  lattice.initialise([&](int ix, int iy, int iz) {
    const auto id = split.global_id(ix, iy, iz);
    return FluidState{1e-3 * flows::random_value(id, -1), flows::random_vector(id, -2, 0.02)};
  });
}

void expect_closed(const Audit& audit) {
  EXPECT_LT(audit.worst_step, 1e-12);
  EXPECT_LT(audit.whole_run, 1e-12);
  EXPECT_LT(audit.bare_momentum, 1e-12);
  EXPECT_LT(audit.mass, 1e-13);
  testing::Test::RecordProperty("worst_step", testing::PrintToString(audit.worst_step));
  testing::Test::RecordProperty("whole_run", testing::PrintToString(audit.whole_run));
  testing::Test::RecordProperty("mass", testing::PrintToString(audit.mass));
}

TEST(Momentum, ClosesInAPeriodicBox) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({10, 9, 8}, {true, true, true}, 1), flows::periodic(),
                  {0.7, 3.0 / 16.0, {1e-5, 0.0, -2e-5}});
  initialise_randomly(lattice);
  expect_closed(audit(lattice, 1000));
  EXPECT_EQ(lattice.wall_impulse(), Vec3{});
}

TEST(Momentum, ClosesBetweenMovingWalls) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({10, 9, 8}, {true, false, true}, 1),
                  flows::plates(1, 9, {-0.03, 0.0, 0.01}, {0.05, 0.0, 0.0}), {0.7, 3.0 / 16.0, {1e-5, 0.0, -2e-5}});
  initialise_randomly(lattice);
  expect_closed(audit(lattice, 1000));
}

TEST(Momentum, ClosesInATube) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({10, 11, 11}, {true, false, false}, 1), flows::tube(11, 5.5),
                  {0.9, bgk_magic(0.9), {1e-4, 0.0, 0.0}});
  initialise_randomly(lattice);
  expect_closed(audit(lattice, 1000));
}

TEST(Momentum, WithoutForcesMassAndMomentumStay) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({10, 9, 8}, {true, true, true}, 1), flows::periodic(), {});
  initialise_randomly(lattice);
  const double nodes = double(lattice.nodes().fluid_nodes());
  const Vec3 momentum = lattice.momentum();
  const double mass = lattice.mass_deviation();
  for (int step = 0; step < 1000; ++step) lattice.step();
  EXPECT_NEAR(lattice.mass_deviation(), mass, 1e-13 * nodes);
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(lattice.momentum()[a], momentum[a], 1e-13 * nodes);
}

TEST(Momentum, ForceOnASolidNodeIsBorneByTheWall) {
  SerialCommunicator communicator;
  Lattice lattice(communicator, Decomposition({10, 11, 11}, {true, false, false}, 1), flows::tube(11, 5.5), {});
  lattice.clear_force();
  lattice.add_force(0, 0, 0, 1.0, 2.0, 3.0);  // a corner outside the tube
  EXPECT_EQ(lattice.wall_force(), (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(lattice.fluid_force(), Vec3{});
  lattice.step();
  EXPECT_EQ(lattice.momentum(), Vec3{});
  lattice.clear_force();
  EXPECT_EQ(lattice.wall_force(), Vec3{});
}

}  // namespace
}  // namespace npfem::flow
