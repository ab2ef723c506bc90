// SPDX-License-Identifier: MPL-2.0
#include "immersed_boundary/immersed_boundary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "communicator/serial_communicator.h"
#include "flows.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

constexpr Index3 kNodes{12, 10, 9};

/// A lattice on one rank with a random velocity field, and random vertices with random forces.
struct Scene {
  explicit Scene(int points, bool walls = false)
      : split(kNodes, {true, !walls, true}, 1),
        lattice(self, split, walls ? flows::plates(1, kNodes[1], {-0.03, 0, 0}, {0.05, 0, 0.01}) : flows::periodic(),
                {}),
        boundary(points, lattice) {
    lattice.initialise([this](int ix, int iy, int iz) {
      return FluidState{0, flows::random_vector(split.global_id(ix, iy, iz), 7, 0.1)};
    });
    for (int v = 0; v < 400; ++v) {
      const Vec3 spread_out = flows::random_vector(v, 1, 30.0);
      const double y = walls ? 0.5 * kNodes[1] * (1 + flows::random_value(v, 100)) : spread_out[1];
      positions.insert(positions.end(), {spread_out[0], y, spread_out[2]});
      const Vec3 force = flows::random_vector(v, 2, 1.0);
      forces.insert(forces.end(), force.begin(), force.end());
    }
    held.resize(400);
    std::iota(held.begin(), held.end(), 0);
    velocities.resize(positions.size());
  }

  void transfer() {
    boundary.interpolate(positions, held, velocities);
    lattice.clear_force();
    boundary.spread(positions, forces);
  }

  template <class Visit>
  void for_each_node(Visit&& visit) const {
    for (int iz = 0; iz < kNodes[2]; ++iz) {
      for (int iy = 0; iy < kNodes[1]; ++iy) {
        for (int ix = 0; ix < kNodes[0]; ++ix) visit(Index3{ix, iy, iz}, Vec3{ix + 0.5, iy + 0.5, iz + 0.5});
      }
    }
  }

  Vec3 node_force(const Index3& n) const { return lattice.force_at(n[0], n[1], n[2]); }
  Vec3 node_velocity(const Index3& n) const { return lattice.velocity_at(n[0], n[1], n[2]); }

  SerialCommunicator self;
  Decomposition split;
  Lattice lattice;
  ImmersedBoundary boundary;
  std::vector<double> positions, forces, velocities;
  std::vector<int> held;
};

class EveryKernel : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Points, EveryKernel, testing::Values(2, 3, 4));

// sum_v F.(interpolated u) = sum_nodes f.u: the same operator, transposed.
TEST_P(EveryKernel, SpreadingIsTheAdjointOfInterpolation) {
  Scene scene(GetParam());
  scene.transfer();
  const double at_vertices =
      std::inner_product(scene.forces.begin(), scene.forces.end(), scene.velocities.begin(), 0.0);
  double at_nodes = 0, size = 0;
  scene.for_each_node([&](const Index3& n, const Vec3&) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double power = scene.node_force(n)[axis] * scene.node_velocity(n)[axis];
      at_nodes += power;
      size += std::abs(power);
    }
  });
  EXPECT_NEAR(at_nodes, at_vertices, 1e-14 * size);
}

TEST_P(EveryKernel, KeepsTheTotalForce) {
  Scene scene(GetParam());
  scene.transfer();
  Vec3 at_nodes{}, at_vertices{};
  scene.for_each_node([&](const Index3& n, const Vec3&) { at_nodes = add(at_nodes, scene.node_force(n)); });
  for (std::size_t i = 0; i < scene.forces.size(); ++i) at_vertices[i % 3] += scene.forces[i];
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(at_nodes[axis], at_vertices[axis], 1e-12);
}

// One vertex away from the faces of the box, so that positions need no unwrapping.
TEST_P(EveryKernel, KeepsTheTorque) {
  Scene scene(GetParam());
  for (int v = 0; v < 200; ++v) {
    const Vec3 position = add({5, 5, 4.5}, flows::random_vector(v, 3, 2.0));
    const Vec3 force = flows::random_vector(v, 4, 1.0);
    scene.positions.assign(position.begin(), position.end());
    scene.forces.assign(force.begin(), force.end());
    scene.lattice.clear_force();
    scene.boundary.spread(scene.positions, scene.forces);
    Vec3 torque{};
    scene.for_each_node([&](const Index3& n, const Vec3& node) {
      torque = add(torque, cross(subtract(node, position), scene.node_force(n)));
    });
    EXPECT_LT(norm(torque), 1e-13);
  }
}

TEST_P(EveryKernel, InterpolatesAUniformFlowExactly) {
  Scene scene(GetParam());
  scene.lattice.initialise([](int, int, int) { return FluidState{0, {0.01, -0.02, 0.03}}; });
  scene.boundary.interpolate(scene.positions, scene.held, scene.velocities);
  for (std::size_t v = 0; v < scene.held.size(); ++v) {
    EXPECT_NEAR(scene.velocities[3 * v], 0.01, 1e-16);
    EXPECT_NEAR(scene.velocities[3 * v + 1], -0.02, 1e-16);
    EXPECT_NEAR(scene.velocities[3 * v + 2], 0.03, 1e-16);
  }
}

TEST_P(EveryKernel, InterpolatesAShearFlowExactlyAwayFromWalls) {
  Scene scene(GetParam(), true);
  scene.lattice.initialise([](int, int iy, int) { return FluidState{0, {0.01 * (iy + 0.5), 0, 0}}; });
  scene.boundary.interpolate(scene.positions, scene.held, scene.velocities);
  for (std::size_t v = 0; v < scene.held.size(); ++v) {
    const double y = scene.positions[3 * v + 1];
    if (y < 2 || y > kNodes[1] - 2) continue;
    EXPECT_NEAR(scene.velocities[3 * v], 0.01 * y, 1e-15);
  }
}

// Whole periods only change integers.
TEST_P(EveryKernel, DoesNotFeelWholePeriods) {
  Scene scene(GetParam());
  for (double& x : scene.positions) x = std::round(x * 1024) / 1024;  // sums with periods are then exact
  scene.transfer();
  const std::vector<double> velocities = scene.velocities;
  std::vector<double> forces;
  scene.for_each_node([&](const Index3& n, const Vec3&) { forces.push_back(scene.node_force(n)[0]); });
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    scene.positions[i] += static_cast<int>(i % 7 - 3) * kNodes[i % 3];
  }
  scene.transfer();
  EXPECT_EQ(scene.velocities, velocities);
  std::size_t next = 0;
  scene.for_each_node([&](const Index3& n, const Vec3&) { EXPECT_EQ(scene.node_force(n)[0], forces[next++]); });
}

// Near walls: what the fluid does not get, the walls get.
TEST_P(EveryKernel, BooksTheForceOnWalls) {
  Scene scene(GetParam(), true);
  scene.transfer();
  const Vec3 on_walls = scene.boundary.force_on_walls(scene.positions, scene.held, scene.forces);
  const Vec3 on_fluid = scene.lattice.fluid_force();
  Vec3 at_vertices{};
  for (std::size_t i = 0; i < scene.forces.size(); ++i) at_vertices[i % 3] += scene.forces[i];
  EXPECT_GT(norm(on_walls), 0.1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(on_fluid[axis] + on_walls[axis], at_vertices[axis], 1e-12);
  }
}

TEST_P(EveryKernel, AVertexBeyondAWallMovesWithTheWall) {
  Scene scene(GetParam(), true);
  scene.positions = {3.3, kNodes[1] + 1.5, 2.2, 3.3, kNodes[1] + 500.0, 2.2, 3.3, -1.5, 2.2, 3.3, -1e12, 2.2};
  scene.forces.assign(12, 1.0);
  scene.held = {0, 1, 2, 3};
  scene.velocities.resize(12);
  scene.boundary.interpolate(scene.positions, scene.held, scene.velocities);
  EXPECT_NEAR(scene.velocities[0], 0.05, 1e-16);
  EXPECT_NEAR(scene.velocities[3], 0.05, 1e-16);
  EXPECT_NEAR(scene.velocities[6], -0.03, 1e-16);
  EXPECT_NEAR(scene.velocities[9], -0.03, 1e-16);
  scene.lattice.clear_force();
  scene.boundary.spread(scene.positions, scene.forces);
  EXPECT_EQ(scene.lattice.fluid_force(), Vec3{});
}

TEST(ImmersedBoundary, RefusesAKernelThatIsNotThere) {
  Scene scene(4);
  EXPECT_THROW(ImmersedBoundary(1, scene.lattice), std::invalid_argument);
  EXPECT_THROW(ImmersedBoundary(5, scene.lattice), std::invalid_argument);
  LatticeOptions options;
  options.node_force = false;
  Lattice without(scene.self, scene.split, flows::periodic(), options);
  EXPECT_THROW(ImmersedBoundary(4, without), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
