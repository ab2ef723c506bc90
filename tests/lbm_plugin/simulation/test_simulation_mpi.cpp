// SPDX-License-Identifier: MPL-2.0
// The same bits on any number of ranks: every rank also runs the whole scene alone and compares.
#include <gtest/gtest.h>

#include <set>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "crowd.h"
#include "mpi_environment.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

std::set<int> ids_of(const Simulation& simulation) {
  std::set<int> ids;
  for (const CellState& cell : simulation.local_cells()) ids.insert(cell.id);
  return ids;
}

void expect_same_as_alone(const flow::Setup& setup, int steps, bool expect_migration) {
  SerialCommunicator self;
  Simulation alone(setup, self);
  Simulation shared(setup, world());
  EXPECT_EQ(shared.state_hash(), alone.state_hash()) << "at the start";
  const std::set<int> first = ids_of(shared);
  for (int i = 0; i < steps; ++i) {
    alone.step();
    shared.step();
  }
  EXPECT_EQ(shared.state_hash(), alone.state_hash());
  EXPECT_EQ(shared.counters().cell_steps, alone.counters().cell_steps);
  EXPECT_EQ(shared.counters().iterations, alone.counters().iterations);
  EXPECT_EQ(shared.counters().worst_residual_pN, alone.counters().worst_residual_pN);
  EXPECT_EQ(shared.volume_error(), alone.volume_error());
  EXPECT_EQ(shared.minimum_gap(), alone.minimum_gap());
  EXPECT_EQ(shared.minimum_wall_gap(), alone.minimum_wall_gap());
  if (setup.coupling.scheme != CouplingScheme::lineage) {
    EXPECT_LT(shared.momentum_error(), 1e-10);
  }
  EXPECT_LT(alone.minimum_gap(), setup.contact.cells.range) << "no cells touch: the test is weak";
  EXPECT_TRUE(shared.failures().empty());

  const auto all = alone.local_cells();
  for (const CellState& cell : shared.local_cells()) {
    EXPECT_EQ(cell.position, all[static_cast<std::size_t>(cell.id)].position);
    EXPECT_EQ(cell.force, all[static_cast<std::size_t>(cell.id)].force);
  }
  const bool moved = world().any(ids_of(shared) != first);
  EXPECT_TRUE(moved || !expect_migration || world().size() == 1) << "no cell has changed its owner: the test is weak";
}

TEST(SameBits, InAShearBox) {
  expect_same_as_alone(capsules::crowd(DomainKind::shear_box, CouplingScheme::implicit, 1), 120, false);
}

TEST(SameBits, InAPeriodicBox) {
  expect_same_as_alone(capsules::crowd(DomainKind::periodic_box, CouplingScheme::implicit, 3), 150, true);
}

TEST(SameBits, InATube) {
  expect_same_as_alone(capsules::crowd(DomainKind::tube, CouplingScheme::implicit, 1), 80, false);
}

TEST(SameBits, WithTheExplicitCoupling) {
  expect_same_as_alone(capsules::crowd(DomainKind::periodic_box, CouplingScheme::peskin, 2), 150, true);
}

TEST(SameBits, WithAViscosityInside) {
  flow::Setup setup = capsules::crowd(DomainKind::periodic_box, CouplingScheme::implicit, 2);
  setup.types[0].interior_viscosity_ratio = 5;
  expect_same_as_alone(setup, 100, false);
}

TEST(SameBits, WithTheCouplingOfTheLineage) {
  for (const DomainKind kind : {DomainKind::periodic_box, DomainKind::shear_box}) {
    flow::Setup setup = capsules::crowd(kind, CouplingScheme::lineage, 2);
    const std::string density = "membrane_density = \"1.5 fg/um2\"\n";
    setup.types = {capsules::capsule("sphere", 2, 2.6, capsules::neo_hookean(0.02) + density),
                   capsules::capsule("icosphere", 1, 1.8, capsules::skalak(0.02, 2) + density)};
    setup.coupling.forcing_iterations = 2;
    expect_same_as_alone(setup, 60, false);
  }
}

TEST(Failures, AreKnownToEveryRank) {
  flow::Setup setup = capsules::crowd(DomainKind::shear_box, CouplingScheme::implicit, 1);
  setup.types[1].options = {
      {"tolerance", 0.0}, {"residual_bound", 0.0}, {"max_iterations", 1}, {"newton_iterations", 0}};
  Simulation simulation(setup, world());
  for (int i = 0; i < 3; ++i) simulation.step();
  ASSERT_EQ(simulation.failures().size(), 2u);
  EXPECT_EQ(simulation.failures()[0].id, 2);
  EXPECT_EQ(simulation.failures()[1].id, 3);
  std::int64_t cells = static_cast<std::int64_t>(simulation.local_cells().size());
  world().sum(std::span(&cells, 1));
  EXPECT_EQ(cells, 5);
}

}  // namespace
}  // namespace npfem::flow
