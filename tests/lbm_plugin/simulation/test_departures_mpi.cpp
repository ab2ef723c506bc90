// SPDX-License-Identifier: MPL-2.0
// Cells leave at the same steps, and leave the same bits behind, on any number of ranks: every rank also runs the whole
// scene alone and compares.
#include <gtest/gtest.h>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "leaving.h"
#include "mpi_environment.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

void expect_same_as_alone(const flow::Setup& setup) {
  SerialCommunicator self;
  Simulation alone(setup, self);
  Simulation shared(setup, world());
  while (alone.cell_count() > 0) {
    ASSERT_LT(alone.steps_done(), 250) << "they do not get out";
    alone.step();
    shared.step();
    ASSERT_EQ(shared.state_hash(), alone.state_hash()) << "after step " << alone.steps_done();
    ASSERT_EQ(shared.departures(), alone.departures()) << "after step " << alone.steps_done();
  }
  EXPECT_EQ(shared.cell_count(), 0);
  EXPECT_TRUE(shared.local_cells().empty());
  EXPECT_EQ(shared.counters().cell_steps, alone.counters().cell_steps);
  EXPECT_EQ(shared.volume_error(), alone.volume_error());
  shared.step();
  alone.step();
  EXPECT_EQ(shared.state_hash(), alone.state_hash()) << "with no cell left";
}

TEST(Departures, AreTheSameOnAnyRanks) {
  expect_same_as_alone(capsules::leaving(CouplingScheme::implicit, 1));
}

TEST(Departures, AreTheSameOnAnyRanksWithSeveralStepsOfTheFluidPerSolve) {
  expect_same_as_alone(capsules::leaving(CouplingScheme::implicit, 3));
  expect_same_as_alone(capsules::leaving(CouplingScheme::lineage, 2));
}

TEST(Departures, AreTheSameOnAnyRanksWithAViscosityInside) {
  flow::Setup setup = capsules::leaving(CouplingScheme::peskin, 2);
  setup.types[0].interior_viscosity_ratio = 4;
  expect_same_as_alone(setup);
}

}  // namespace
}  // namespace npfem::flow
