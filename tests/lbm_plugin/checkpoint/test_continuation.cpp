// SPDX-License-Identifier: MPL-2.0
// A run that stops and goes on has the bits of one that never stopped, whoever goes on with it: every rank runs the
// whole scene alone, and all together take turns with it.
#include <gtest/gtest.h>

#include "capsules.h"
#include "checkpoint/cell_section.h"
#include "checkpoint/checkpoint_file.h"
#include "checkpoint/checkpoint_header.h"
#include "communicator/serial_communicator.h"
#include "crowd.h"
#include "folder_of_rank_zero.h"
#include "leaving.h"
#include "mpi_environment.h"
#include "scratch_folder.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

void advance(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

void save(const Simulation& simulation, Communicator& communicator, const std::filesystem::path& path) {
  CheckpointWriter file(communicator, path);
  CheckpointHeader header;
  simulation.save(file, header);
  file.publish(to_json(header));
  communicator.barrier();
}

Simulation continued(const flow::Setup& setup, Communicator& communicator, const std::filesystem::path& path) {
  CheckpointFile file(communicator, path);
  file.verify();
  return Simulation(setup, communicator, file, header_from_json(file.header()));
}

/// The checkpoint knows where the cells have come to: the cuts between ranks that go on with it depend on that.
void expect_centres(const flow::Setup& setup, const Simulation& simulation, const std::filesystem::path& path) {
  SerialCommunicator self;
  CheckpointFile file(self, path);
  const std::vector<CellStart> present = load_present(setup.cells, header_from_json(file.header()).departures, file);
  const auto cells = simulation.local_cells();
  ASSERT_EQ(present.size(), cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(present[i].type, cells[i].type);
    Vec3 sum{};
    for (std::size_t n = 0; n < cells[i].position.size(); ++n) sum[n % 3] += cells[i].position[n];
    const Vec3 mean = scale(3.0 / static_cast<double>(cells[i].position.size()), sum);
    EXPECT_LT(norm(subtract(present[i].centre, mean)), 1e-12);
  }
}

/// `first` steps alone, `second` by all, the rest alone again.
void expect_same_as_straight(const flow::Setup& setup, int first, int second, int rest) {
  const ScratchFolder own("continuation");
  SerialCommunicator self;
  Simulation straight(setup, self);
  advance(straight, first);
  save(straight, self, own.path() / "alone.npfem");

  const auto shared_folder = folder_of_rank_zero(own);
  Simulation shared = continued(setup, world(), shared_folder / "alone.npfem");
  EXPECT_EQ(shared.state_hash(), straight.state_hash()) << "as read";
  EXPECT_EQ(shared.steps_done(), first);
  advance(shared, second);
  save(shared, world(), shared_folder / "shared.npfem");
  advance(straight, second);
  EXPECT_EQ(shared.state_hash(), straight.state_hash());

  expect_centres(setup, straight, shared_folder / "shared.npfem");
  Simulation last = continued(setup, self, shared_folder / "shared.npfem");
  advance(last, rest);
  advance(straight, rest);
  EXPECT_EQ(last.state_hash(), straight.state_hash());
  const Counters found = last.counters();
  const Counters expected = straight.counters();
  EXPECT_EQ(found.cell_steps, expected.cell_steps);
  EXPECT_EQ(found.iterations, expected.iterations);
  EXPECT_EQ(found.worst_residual_pN, expected.worst_residual_pN);
  EXPECT_EQ(last.volume_error(), straight.volume_error());
  if (setup.coupling.scheme != CouplingScheme::lineage) {
    EXPECT_LT(last.momentum_error(), 1e-10);
  }
  EXPECT_EQ(last.steps_done(), straight.steps_done());
  EXPECT_EQ(last.departures(), straight.departures());
  EXPECT_EQ(last.cell_count(), straight.cell_count());
  const auto cells = last.local_cells();
  const auto expected_cells = straight.local_cells();
  ASSERT_EQ(cells.size(), expected_cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].position, expected_cells[i].position);
    EXPECT_EQ(cells[i].force, expected_cells[i].force);
    EXPECT_EQ(cells[i].iterations, expected_cells[i].iterations);
    EXPECT_EQ(cells[i].residual, expected_cells[i].residual);
  }
  world().barrier();
}

TEST(Continuation, OfAShearBox) {
  expect_same_as_straight(capsules::crowd(DomainKind::shear_box, CouplingScheme::implicit, 1), 20, 20, 20);
}

TEST(Continuation, BetweenTwoStepsOfTheCells) {
  expect_same_as_straight(capsules::crowd(DomainKind::periodic_box, CouplingScheme::implicit, 2), 21, 10, 20);
  expect_same_as_straight(capsules::crowd(DomainKind::tube, CouplingScheme::implicit, 3), 10, 10, 1);
}

TEST(Continuation, OfTheExplicitCoupling) {
  expect_same_as_straight(capsules::crowd(DomainKind::periodic_box, CouplingScheme::peskin, 2), 31, 9, 12);
}

TEST(Continuation, OfTheCouplingOfTheLineage) {
  flow::Setup setup = capsules::crowd(DomainKind::periodic_box, CouplingScheme::lineage, 2);
  setup.types = {
      capsules::capsule("sphere", 2, 2.6, capsules::neo_hookean(0.02) + "membrane_density = \"1.5 fg/um2\"\n"),
      capsules::capsule("icosphere", 1, 1.8, capsules::skalak(0.02, 2) + "membrane_density = \"1.5 fg/um2\"\n")};
  expect_same_as_straight(setup, 11, 9, 6);
}

TEST(Continuation, OfAViscosityInside) {
  for (const CouplingScheme scheme : {CouplingScheme::implicit, CouplingScheme::peskin}) {
    flow::Setup setup = capsules::crowd(DomainKind::periodic_box, scheme, 3);
    setup.types[0].interior_viscosity_ratio = 5;
    expect_same_as_straight(setup, 31, 7, 6);
  }
}

/// One leaves before the first stop, one while all ranks go on with the run, and the last two after that.
TEST(Continuation, WhileCellsLeave) {
  expect_same_as_straight(capsules::leaving(CouplingScheme::implicit, 1), 60, 20, 30);
  expect_same_as_straight(capsules::leaving(CouplingScheme::implicit, 3), 61, 20, 30);
  expect_same_as_straight(capsules::leaving(CouplingScheme::peskin, 2), 61, 20, 30);
}

TEST(Continuation, OfAFluidAlone) {
  flow::Setup setup = capsules::crowd(DomainKind::tube, CouplingScheme::implicit, 1);
  setup.cells.clear();
  expect_same_as_straight(setup, 7, 5, 5);
}

TEST(Continuation, WhatIsInTheFileDoesNotDependOnTheRanks) {
  const ScratchFolder own("canonical");
  const auto folder = folder_of_rank_zero(own);
  const flow::Setup setup = capsules::crowd(DomainKind::shear_box, CouplingScheme::implicit, 2);
  SerialCommunicator self;
  Simulation alone(setup, self);
  Simulation shared(setup, world());
  advance(alone, 11);
  advance(shared, 11);
  save(alone, self, own.path() / "alone.npfem");
  save(shared, world(), folder / "shared.npfem");
  CheckpointFile a(self, own.path() / "alone.npfem");
  CheckpointFile b(self, folder / "shared.npfem");
  for (const char* section : {"fluid", "placed", "cells"}) {
    ASSERT_EQ(a.words(section), b.words(section));
    std::vector<Word> first(static_cast<std::size_t>(a.words(section)));
    std::vector<Word> second(first.size());
    a.read(section, 0, first);
    b.read(section, 0, second);
    EXPECT_EQ(first, second) << section;
  }
  world().barrier();
}

TEST(Continuation, NeedsTheSameGeometryAndCells) {
  const ScratchFolder own("another");
  const auto folder = folder_of_rank_zero(own);
  const flow::Setup setup = capsules::crowd(DomainKind::tube, CouplingScheme::implicit, 1);
  Simulation simulation(setup, world());
  save(simulation, world(), folder / "tube.npfem");
  flow::Setup narrower = setup;
  narrower.domain.tube_radius = 5.9;
  EXPECT_THROW(continued(narrower, world(), folder / "tube.npfem"), std::runtime_error);
  flow::Setup fewer = setup;
  fewer.cells.pop_back();
  EXPECT_THROW(continued(fewer, world(), folder / "tube.npfem"), std::runtime_error);
  flow::Setup exchanged = setup;
  std::swap(exchanged.cells[1], exchanged.cells[2]);  // of two types
  EXPECT_THROW(continued(exchanged, world(), folder / "tube.npfem"), std::runtime_error);
  world().barrier();
}

}  // namespace
}  // namespace npfem::flow
