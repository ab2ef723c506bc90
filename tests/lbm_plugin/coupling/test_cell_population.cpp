// SPDX-License-Identifier: MPL-2.0
// On any number of ranks: who owns which cell, and whether a cell keeps its state when it changes owner.
#include "coupling/cell_population.h"

#include <gtest/gtest.h>

#include <cmath>

#include "capsules.h"
#include "flows.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

constexpr int kCells = 12;

flow::Setup setup_with_cells() {
  flow::Setup setup = capsules::fluid(DomainKind::periodic_box, {12, 11, 10}, 1.0);
  setup.types = {
      capsules::capsule("sphere", 1, 1.0, capsules::neo_hookean(0.01)),
      capsules::capsule("icosphere", 1, 1.0, capsules::neo_hookean(0.01) + "membrane_density = \"0.5 fg/um2\"")};
  for (int c = 0; c < kCells; ++c) capsules::place(setup, c % 2, flows::random_vector(c, 0, 20.0));
  return setup;
}

class CellPopulationTest : public testing::Test {
 protected:
  CellPopulationTest()
      : setup(setup_with_cells()),
        split(setup.domain.nodes, setup.domain.periodic(), world().size()),
        cells(setup, world(), split, 1.0) {
    double mass = 1.5;  // one for each type
    cells.carry_fluid([&](std::span<const double> areas) { return std::vector<double>(areas.size(), mass++); });
  }

  std::int64_t total(std::int64_t mine) const {
    world().sum(std::span(&mine, 1));
    return mine;
  }

  /// Moves every cell by its own vector.
  void scatter(int salt) {
    std::vector<double> positions;
    cells.read("position", positions);
    for (const auto& cell : cells.cells()) {
      const Vec3 shift = flows::random_vector(cell.id, salt, 15.0);
      for (std::size_t i = 0; i < 3 * cells.vertices_of(cell.type); ++i) {
        positions[3 * cell.first_vertex + i] += shift[i % 3];
      }
    }
    cells.write("position", positions);
  }

  void expect_owned_by_centroid() const {
    for (const auto& cell : cells.cells()) {
      std::vector<double> positions(3 * cells.vertices_of(cell.type));
      cells.batch(cell.type).read("position", cell.slot, 1, positions);
      Index3 node{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (std::size_t v = axis; v < positions.size(); v += 3) sum += positions[v];
        const double centre = 3 * sum / static_cast<double>(positions.size());
        node[axis] = split.wrap(static_cast<int>(axis), static_cast<int>(std::floor(centre)));
      }
      EXPECT_TRUE(split.box(world().rank()).contains(node[0], node[1], node[2]));
    }
  }

  flow::Setup setup;
  Decomposition split;
  CellPopulation cells;
};

TEST_F(CellPopulationTest, EveryCellHasOneOwnerWhereItsCentroidIs) {
  EXPECT_EQ(total(static_cast<std::int64_t>(cells.cells().size())), kCells);
  expect_owned_by_centroid();
}

TEST_F(CellPopulationTest, IsInOrderOfIdWithFlatVertices) {
  std::size_t vertices = 0;
  int last = -1;
  for (const auto& cell : cells.cells()) {
    EXPECT_GT(cell.id, last);
    last = cell.id;
    EXPECT_EQ(cell.type, cell.id % 2);
    EXPECT_EQ(cell.first_vertex, vertices);
    vertices += cells.vertices_of(cell.type);
  }
  EXPECT_EQ(cells.vertices().size(), vertices);
}

TEST_F(CellPopulationTest, MovesCellsWithAllTheirState) {
  std::vector<double> velocities, held;
  for (const VertexId& id : cells.vertices()) {
    const Vec3 velocity = flows::random_vector(id.cell, id.vertex, 1.0);
    const Vec3 force = flows::random_vector(id.cell + 1000, id.vertex, 1.0);
    velocities.insert(velocities.end(), velocity.begin(), velocity.end());
    held.insert(held.end(), force.begin(), force.end());
  }
  cells.write("velocity", velocities);
  cells.write("held_force", held);
  for (int round = 0; round < 5; ++round) {
    scatter(round);
    const std::uint64_t before = world().sum_hash(cells.state_hash());
    cells.migrate();
    EXPECT_EQ(world().sum_hash(cells.state_hash()), before);
    EXPECT_EQ(total(static_cast<std::int64_t>(cells.cells().size())), kCells);
    expect_owned_by_centroid();
    cells.read("velocity", velocities);
    cells.read("held_force", held);
    for (std::size_t v = 0; v < cells.vertices().size(); ++v) {
      const VertexId id = cells.vertices()[v];
      const Vec3 velocity = flows::random_vector(id.cell, id.vertex, 1.0);
      const Vec3 force = flows::random_vector(id.cell + 1000, id.vertex, 1.0);
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_EQ(velocities[3 * v + a], velocity[a]);
        EXPECT_EQ(held[3 * v + a], force[a]);
      }
    }
    for (const auto& cell : cells.cells()) {
      std::vector<double> mass(cells.vertices_of(cell.type));
      cells.batch(cell.type).read("ambient_mass", cell.slot, 1, mass);
      for (const double m : mass) EXPECT_EQ(m, 1.5 + cell.type);
    }
  }
}

TEST_F(CellPopulationTest, AddsUpTheMomentumOfItsMass) {
  std::vector<double> velocities;
  for (std::size_t v = 0; v < cells.vertices().size(); ++v) velocities.insert(velocities.end(), {1.0, -2.0, 0.5});
  cells.write("velocity", velocities);
  Vec3 momentum = cells.solid_momentum();
  world().sum(momentum);
  const double mass = kCells / 2 * 0.5 * setup.types[1].model->measure("rest_area");
  EXPECT_NEAR(momentum[0], mass, 1e-12 * mass);
  EXPECT_NEAR(momentum[1], -2 * mass, 1e-12 * mass);
  EXPECT_NEAR(momentum[2], 0.5 * mass, 1e-12 * mass);
}

TEST_F(CellPopulationTest, HashTellsCellsApart) {
  const std::uint64_t before = world().sum_hash(cells.state_hash());
  scatter(3);
  EXPECT_NE(world().sum_hash(cells.state_hash()), before);
}

}  // namespace
}  // namespace npfem::flow
