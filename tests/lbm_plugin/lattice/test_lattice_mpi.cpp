// SPDX-License-Identifier: MPL-2.0
// The same bits for any number of ranks; every rank runs the whole box by itself for comparison.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "communicator/serial_communicator.h"
#include "invariance.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

TEST(LatticeMpi, SameBitsAsOnOneRank) {
  SerialCommunicator alone;
  for (const auto& run : flows::invariance_cases()) {
    EXPECT_EQ(flows::hash_after_run(world(), run, 50), flows::hash_after_run(alone, run, 50)) << run.name;
  }
}

TEST(LatticeMpi, VelocityHaloIsThatOfTheWholeBox) {
  SerialCommunicator alone;
  for (const auto& run : flows::invariance_cases()) {
    const Decomposition split(run.nodes, run.periodic, world().size());
    Lattice part(world(), split, run.geometry, {});
    Lattice whole(alone, Decomposition(run.nodes, run.periodic, 1), run.geometry, {});
    const auto state = [&](int ix, int iy, int iz) {
      return FluidState{0.0, flows::random_vector(split.global_id(ix, iy, iz), 0, 0.02)};
    };
    part.initialise(state);
    whole.initialise(state);
    const NodeMap& grid = part.nodes();
    for (int iz = -2; iz < grid.size(2) + 2; ++iz) {
      for (int iy = -2; iy < grid.size(1) + 2; ++iy) {
        for (int ix = -2; ix < grid.size(0) + 2; ++ix) {
          const auto& begin = grid.own().begin;
          ASSERT_EQ(part.velocity_at(ix, iy, iz), whole.velocity_at(begin[0] + ix, begin[1] + iy, begin[2] + iz))
              << run.name << ' ' << ix << ' ' << iy << ' ' << iz;
        }
      }
    }
  }
}

TEST(LatticeMpi, MomentumClosesOverTheRanks) {
  const auto run = flows::invariance_cases()[2];
  Lattice lattice(world(), Decomposition(run.nodes, run.periodic, world().size()), run.geometry,
                  {0.7, 3.0 / 16.0, {1e-4, 0.0, 0.0}});
  std::array<double, 3> defect{};
  double force = 0.0;
  for (int step = 0; step < 100; ++step) {
    const Vec3 before = lattice.bare_momentum();
    lattice.step();
    const Vec3 after = lattice.bare_momentum();
    for (std::size_t a = 0; a < 3; ++a) {
      defect[a] += after[a] - before[a] - lattice.wall_impulse()[a] - lattice.fluid_force()[a];
    }
    force += lattice.fluid_force()[0];
  }
  world().sum(defect);
  world().sum(std::span(&force, 1));
  for (const double d : defect) EXPECT_LT(std::abs(d), 1e-12 * force);
}

TEST(LatticeMpi, ABadGeometryFailsOnAllRanks) {
  const Decomposition split({8, 8, 8}, {true, true, true}, world().size());
  const Geometry geometry{[](int ix, int iy, int iz) { return ix + iy + iz == 12 && ix == 4 ? wall(0) : kFluid; }, {}};
  EXPECT_THROW(Lattice(world(), split, geometry, {}), std::runtime_error);
}

}  // namespace
}  // namespace npfem::flow
