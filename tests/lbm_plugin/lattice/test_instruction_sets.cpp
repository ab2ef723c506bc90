// SPDX-License-Identifier: MPL-2.0
// The kernels of all instruction sets give the same bits, in both precisions and for every kind of collision.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "communicator/serial_communicator.h"
#include "flows.h"
#include "immersed_boundary/immersed_boundary.h"

namespace npfem::flow {
namespace {

std::vector<InstructionSet> available() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (set <= best_instruction_set()) sets.push_back(set);
  }
  return sets;
}

/// A tube with forces, vertices, and a fluid of another viscosity in one half.
std::uint64_t hash_after_run(LatticeOptions options, int points) {
  SerialCommunicator communicator;
  const Decomposition split({19, 13, 13}, {true, false, false}, 1);
  Lattice lattice(communicator, split, flows::tube(13, 6.2), options);
  lattice.initialise([&](int ix, int iy, int iz) {
    const auto id = split.global_id(ix, iy, iz);
    return FluidState{1e-3 * flows::random_value(id, -1), flows::random_vector(id, -2, 0.02)};
  });
  lattice.nodes().for_each_fluid_node([&](int ix, int iy, int iz) {
    if (iy < 6) lattice.set_inside(ix, iy, iz);
  });
  std::vector<double> positions, forces, velocities(3 * 50);
  std::vector<int> held;
  for (int v = 0; v < 50; ++v) {
    const Vec3 position = flows::random_vector(v, 5, 4.0);
    positions.insert(positions.end(), {position[0], 6.5 + position[1], 6.5 + position[2]});
    held.push_back(v);
  }
  ImmersedBoundary boundary(points, lattice);
  for (int step = 0; step < 10; ++step) {
    lattice.update_velocity();
    boundary.interpolate(positions, held, velocities);
    forces = velocities;
    lattice.clear_force();
    boundary.spread(positions, forces);
    lattice.step();
  }
  return lattice.state_hash();
}

TEST(InstructionSets, GiveTheSameBits) {
  if (available().size() == 1) GTEST_SKIP() << "this processor has one instruction set only";
  for (const auto precision : {FluidPrecision::double_precision, FluidPrecision::single_precision}) {
    for (const auto collision : {Collision::two_relaxation_times, Collision::regularised}) {
      for (const double inside : {0.0, 1.4}) {
        for (const int points : {2, 3, 4}) {
          LatticeOptions options{.tau = 0.8, .body_force = {1e-5, 0, -2e-5}};
          options.precision = precision;
          options.collision = collision;
          options.inside_tau = inside;
          options.instruction_set = InstructionSet::baseline;
          const std::uint64_t baseline = hash_after_run(options, points);
          for (const InstructionSet set : available()) {
            options.instruction_set = set;
            EXPECT_EQ(hash_after_run(options, points), baseline) << int(set) << ' ' << int(precision) << ' ' << points;
          }
          options.instruction_set.reset();
          options.tau = 0.81;
          EXPECT_NE(hash_after_run(options, points), baseline);
        }
      }
    }
  }
}

}  // namespace
}  // namespace npfem::flow
