// SPDX-License-Identifier: MPL-2.0
#include "simulation/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "capsules.h"
#include "communicator/serial_communicator.h"

namespace npfem::flow {
namespace {

flow::Setup two_cells_in_shear() {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {16, 14, 14}, 1.0);
  setup.domain.plate_speed = 0.1;
  setup.start_developed = true;
  setup.contact.cells = {1.0, 1e-3};
  setup.types = {capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.02)),
                 capsules::capsule("icosphere", 1, 2.0, capsules::skalak(0.02, 2))};
  setup.types[1].name = "other";
  capsules::place(setup, 1, {13, 8, 7});
  capsules::place(setup, 0, {6, 6, 7});
  return setup;
}

TEST(Simulation, AdvancesFluidAndCells) {
  SerialCommunicator self;
  Simulation simulation(two_cells_in_shear(), self);
  const std::uint64_t start = simulation.state_hash();
  for (int i = 0; i < 50; ++i) simulation.step();
  EXPECT_NE(simulation.state_hash(), start);
  EXPECT_EQ(simulation.steps_done(), 50);
  EXPECT_DOUBLE_EQ(simulation.time_us(), 50.0);
  EXPECT_TRUE(simulation.failures().empty());
  EXPECT_LT(simulation.volume_error(), 0.01);
  const Counters counters = simulation.counters();
  EXPECT_EQ(counters.cell_steps, 100);
  EXPECT_GT(counters.iterations, 0);
  EXPECT_LT(counters.worst_residual_pN, 1e-6);
  EXPECT_GT(counters.fluid_seconds, 0);
  EXPECT_GT(counters.cell_seconds, 0);
  EXPECT_GT(counters.exchange_seconds, 0);
}

TEST(Simulation, ShowsItsCellsInOrderOfId) {
  SerialCommunicator self;
  const flow::Setup setup = two_cells_in_shear();
  Simulation simulation(setup, self);
  simulation.step();
  const std::vector<CellState> cells = simulation.local_cells();
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(simulation.cell_count(), 2);
  EXPECT_EQ(cells[0].id, 0);
  EXPECT_EQ(cells[0].type, 1);
  EXPECT_EQ(cells[1].id, 1);
  EXPECT_EQ(cells[1].type, 0);
  EXPECT_EQ(cells[1].position.size(), setup.types[0].shape.size());
  EXPECT_EQ(cells[1].velocity.size(), cells[1].position.size());
  EXPECT_EQ(cells[1].force.size(), cells[1].position.size());
  EXPECT_EQ(cells[1].status, NPFEM_CELL_CONVERGED);
  EXPECT_NEAR(cells[1].volume, setup.types[0].model->measure("rest_volume"), 0.01);
  EXPECT_NEAR(cells[1].area, setup.types[0].model->measure("rest_area"), 0.1);
}

TEST(Simulation, TurnsAndMovesTheShapeOfACell) {
  SerialCommunicator self;
  flow::Setup setup = capsules::fluid(DomainKind::periodic_box, {12, 12, 12}, 1.0);
  setup.types = {capsules::capsule("sphere", 1, 2.0, capsules::neo_hookean(0.01))};
  // A quarter turn about z: x -> y, y -> -x.
  setup.cells = {{0, {5, 6, 7}, {0, -1, 0, 1, 0, 0, 0, 0, 1}}};
  Simulation simulation(setup, self);
  const CellState cell = simulation.local_cells()[0];
  for (std::size_t v = 0; v < cell.position.size(); v += 3) {
    EXPECT_NEAR(cell.position[v], 5 - setup.types[0].shape[v + 1], 1e-14);
    EXPECT_NEAR(cell.position[v + 1], 6 + setup.types[0].shape[v], 1e-14);
    EXPECT_NEAR(cell.position[v + 2], 7 + setup.types[0].shape[v + 2], 1e-14);
  }
}

// A capsule at rest in a fluid at rest stays what and where it is.
TEST(Simulation, LeavesAForceFreeCellAlone) {
  for (const auto scheme : {CouplingScheme::implicit, CouplingScheme::peskin}) {
    SerialCommunicator self;
    flow::Setup setup = capsules::fluid(DomainKind::periodic_box, {12, 12, 12}, 1.0);
    setup.coupling.scheme = scheme;
    setup.types = {capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01))};
    capsules::place(setup, 0, {5.3, 6.1, 7.7});
    Simulation simulation(setup, self);
    const std::vector<double> before = simulation.local_cells()[0].position;
    for (int i = 0; i < 100; ++i) simulation.step();
    const std::vector<double> after = simulation.local_cells()[0].position;
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-10);
  }
}

// A cell under tension pushes on the fluid from the first step on, as it would in Peskin's method.
TEST(Simulation, HoldsTheForcesOfTheStart) {
  SerialCommunicator self;
  flow::Setup setup = capsules::fluid(DomainKind::periodic_box, {14, 14, 14}, 1.0);
  setup.types = {capsules::inflated(capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01)), 1.05)};
  capsules::place(setup, 0, {7, 7, 7});
  Simulation simulation(setup, self);
  const CellState cell = simulation.local_cells()[0];
  for (std::size_t v = 0; v < cell.force.size(); v += 3) {
    double inwards = 0;
    for (std::size_t a = 0; a < 3; ++a) inwards -= cell.force[v + a] * (cell.position[v + a] - 7);
    EXPECT_GT(inwards, 1e-4);
  }
  setup.coupling.scheme = CouplingScheme::peskin;
  Simulation explicit_one(setup, self);
  simulation.step();
  explicit_one.step();
  const CellState a = simulation.local_cells()[0], b = explicit_one.local_cells()[0];
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.force.size(); ++i) {
    difference = std::max(difference, std::abs(a.force[i] - b.force[i]));
    size = std::max(size, std::abs(b.force[i]));
  }
  EXPECT_LT(difference, 0.02 * size);
}

TEST(Simulation, DoesNotFeelAShiftByOnePeriod) {
  SerialCommunicator self;
  flow::Setup setup = two_cells_in_shear();
  Simulation here(setup, self);
  setup.cells[0].centre[0] += 16;
  setup.cells[0].centre[2] -= 28;
  setup.cells[1].centre[0] -= 48;
  Simulation there(setup, self);
  for (int i = 0; i < 100; ++i) {
    here.step();
    there.step();
  }
  const auto a = here.local_cells(), b = there.local_cells();
  for (std::size_t i = 0; i < a[0].position.size(); ++i) {
    const Vec3 shift{16, 0, -28};
    EXPECT_NEAR(b[0].position[i], a[0].position[i] + shift[i % 3], 1e-9);
    EXPECT_NEAR(b[0].force[i], a[0].force[i], 1e-10);
  }
  for (std::size_t i = 0; i < a[1].position.size(); ++i) {
    EXPECT_NEAR(b[1].position[i], a[1].position[i] + (i % 3 == 0 ? -48 : 0), 1e-9);
  }
}

TEST(Simulation, SolvesTheCellsEverySoManyFluidSteps) {
  SerialCommunicator self;
  flow::Setup setup = two_cells_in_shear();
  setup.coupling.steps_per_solve = 3;
  Simulation simulation(setup, self);
  for (int i = 0; i < 7; ++i) simulation.step();
  EXPECT_EQ(simulation.counters().cell_steps, 2 * 3);  // before steps 1, 4 and 7
}

TEST(Simulation, NamesACellThatFailsAndKeepsIt) {
  SerialCommunicator self;
  flow::Setup setup = two_cells_in_shear();
  setup.types[1].options = {{"tolerance", 0.0}, {"residual_bound", 0.0}, {"max_iterations", 1}, {"newton_iterations", 0}};
  Simulation simulation(setup, self);
  for (int i = 0; i < 5; ++i) simulation.step();
  ASSERT_EQ(simulation.failures().size(), 1u) << "named once, when it fails first";
  const CellFailure& failure = simulation.failures()[0];
  EXPECT_EQ(failure.id, 0);
  EXPECT_EQ(failure.type, 1);
  EXPECT_GE(failure.step, 0);
  EXPECT_FALSE(failure.reason.empty());
  EXPECT_EQ(simulation.local_cells().size(), 2u);
}

TEST(Simulation, NamesACellThatTheExplicitCouplingLoses) {
  SerialCommunicator self;
  flow::Setup setup = two_cells_in_shear();
  setup.coupling.scheme = CouplingScheme::peskin;
  setup.types[0] = capsules::capsule("sphere", 2, 3.0, capsules::skalak(0.5, 1000));
  Simulation simulation(setup, self);
  for (int i = 0; i < 100 && simulation.failures().empty(); ++i) simulation.step();
  ASSERT_FALSE(simulation.failures().empty());
  for (const CellState& cell : simulation.local_cells()) {
    for (const double x : cell.position) EXPECT_TRUE(std::isfinite(x));
  }
}

TEST(Simulation, RunsWithoutCells) {
  SerialCommunicator self;
  flow::Setup setup = capsules::fluid(DomainKind::plates, {4, 8, 4}, 1.0);
  setup.body_force = {1e-5, 0, 0};
  Simulation simulation(setup, self);
  for (int i = 0; i < 10; ++i) simulation.step();
  EXPECT_GT(simulation.lattice().node_velocity(1, 4, 1)[0], 5e-5);
  EXPECT_EQ(simulation.counters().cell_steps, 0);
  EXPECT_EQ(simulation.volume_error(), 0);
  EXPECT_TRUE(std::isinf(simulation.minimum_gap()));
}

TEST(Simulation, RefusesMassiveCellsInTheExplicitCoupling) {
  SerialCommunicator self;
  flow::Setup setup = two_cells_in_shear();
  setup.coupling.scheme = CouplingScheme::peskin;
  setup.types[0] =
      capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.02) + "membrane_density = \"0.1 fg/um2\"");
  EXPECT_THROW(Simulation(setup, self), std::invalid_argument);
}

TEST(Simulation, RefusesAShapeThatIsNotOfItsModel) {
  SerialCommunicator self;
  flow::Setup setup = two_cells_in_shear();
  setup.types[0].shape.pop_back();
  EXPECT_THROW(Simulation(setup, self), std::invalid_argument);
  setup = two_cells_in_shear();
  setup.cells[0].type = 2;
  EXPECT_THROW(Simulation(setup, self), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
