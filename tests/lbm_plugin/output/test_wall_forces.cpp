// SPDX-License-Identifier: MPL-2.0
#include "output/wall_forces.h"

#include <gtest/gtest.h>

#include "flows.h"
#include "geometry/vec3.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

struct Case {
  Index3 nodes;
  std::array<bool, 3> periodic;
  Geometry geometry;
};

std::vector<Case> cases() {
  return {{{9, 7, 8}, {true, false, true}, flows::plates(1, 7, {-0.02, 0, 0.01}, {0.03, 0, 0})},
          {{8, 11, 11}, {true, false, false}, flows::tube(11, 5.2)}};
}

TEST(WallForces, KnowTheImpulseOfTheStep) {
  for (const Case& c : cases()) {
    const Decomposition split(c.nodes, c.periodic, world().size());
    Lattice lattice(world(), split, c.geometry, {0.8, 3.0 / 16.0, {1e-5, 2e-6, -3e-6}});
    for (int step = 0; step < 5; ++step) {
      lattice.update_velocity();
      lattice.clear_force();
      flows::add_random_force(lattice, step, 1e-4);
      lattice.step();
    }
    const std::vector<Vec3> forces = wall_forces(lattice, world());
    Vec3 expected = lattice.wall_impulse(), sum{};
    world().sum(expected);
    for (const Vec3& force : forces) sum = add(sum, force);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis], expected[axis], 1e-11);
  }
}

/// Steady Couette flow: both plates pull with mu U / H times their area, one forwards, one backwards.
TEST(WallForces, TellThePlatesApart) {
  const Case c{{6, 10, 4}, {true, false, true}, flows::plates(1, 10, {-0.01, 0, 0}, {0.01, 0, 0})};
  const Decomposition split(c.nodes, c.periodic, world().size());
  Lattice lattice(world(), split, c.geometry, {0.9, 3.0 / 16.0, {}});
  for (int step = 0; step < 4000; ++step) lattice.step();
  const std::vector<Vec3> forces = wall_forces(lattice, world());
  const double stress = lattice_viscosity(0.9) * 0.02 / 10;
  EXPECT_NEAR(forces[1][0], stress * 24, 1e-11);
  EXPECT_NEAR(forces[0][0], -stress * 24, 1e-11);
}

/// Plates that move at half of their speed pull half as much.
TEST(WallForces, FollowTheSpeedOfThePlates) {
  const Case c{{6, 10, 4}, {true, false, true}, flows::plates(1, 10, {-0.01, 0, 0}, {0.01, 0, 0})};
  const Decomposition split(c.nodes, c.periodic, world().size());
  Lattice lattice(world(), split, c.geometry, {0.9, 3.0 / 16.0, {}});
  for (const int plate : {0, 1}) lattice.set_boundary_factor(plate, 0.5);
  for (int step = 0; step < 4000; ++step) lattice.step();
  const double stress = lattice_viscosity(0.9) * 0.01 / 10;
  EXPECT_NEAR(wall_forces(lattice, world())[1][0], stress * 24, 1e-11);
}

}  // namespace
}  // namespace npfem::flow
