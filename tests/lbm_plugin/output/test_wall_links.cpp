// SPDX-License-Identifier: MPL-2.0
#include "output/wall_links.h"

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

TEST(WallLinks, KnowTheImpulseOfTheStep) {
  for (const Case& c : cases()) {
    const Decomposition split(c.nodes, c.periodic, world().size());
    Lattice lattice(world(), split, c.geometry, {0.8, 3.0 / 16.0, {1e-5, 2e-6, -3e-6}});
    const WallLinks links(lattice, c.geometry);
    for (int step = 0; step < 5; ++step) {
      lattice.update_velocity();
      lattice.clear_force();
      flows::add_random_force(lattice, step, 1e-4);
      lattice.step();
    }
    const std::vector<Vec3> forces = links.forces(lattice, world());
    for (std::size_t boundary = 0; boundary < forces.size(); ++boundary) {
      Vec3 expected = lattice.wall_impulse_of(static_cast<int>(boundary));
      world().sum(expected);
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(forces[boundary][axis], expected[axis], 1e-11);
    }
  }
}

/// Steady Couette flow: both plates pull with mu U / H times their area, one forwards, one backwards.
TEST(WallLinks, TellThePlatesApart) {
  const Case c{{6, 10, 4}, {true, false, true}, flows::plates(1, 10, {-0.01, 0, 0}, {0.01, 0, 0})};
  const Decomposition split(c.nodes, c.periodic, world().size());
  Lattice lattice(world(), split, c.geometry, {0.9, 3.0 / 16.0, {}});
  for (int step = 0; step < 4000; ++step) lattice.step();
  const std::vector<Vec3> forces = WallLinks(lattice, c.geometry).forces(lattice, world());
  const double stress = lattice_viscosity(0.9) * 0.02 / 10;
  EXPECT_NEAR(forces[1][0], stress * 24, 1e-11);
  EXPECT_NEAR(forces[0][0], -stress * 24, 1e-11);
}

}  // namespace
}  // namespace npfem::flow
