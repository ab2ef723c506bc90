// SPDX-License-Identifier: MPL-2.0
#include "simulation/departures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "leaving.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

Domain box_open_along_x_and_z() {
  Domain domain;
  domain.nodes = {40, 20, 30};
  domain.dx = 0.5;
  domain.openings = {{.face = Face::x_low}, {.face = Face::x_high}, {.face = Face::z_high}};
  return domain;
}

TEST(OpeningReached, ByOneVertexNearerThanTheKernelOfTheLastNodes) {
  const Domain domain = box_open_along_x_and_z();  // 20 x 10 x 15 um
  using Place = std::vector<double>;
  EXPECT_EQ(opening_reached(domain, Place{10, 5, 7, 18.75, 5, 7}), std::nullopt) << "2.5 nodes: the kernel is 0 there";
  EXPECT_EQ(opening_reached(domain, Place{10, 5, 7, 18.76, 5, 7}), Face::x_high);
  EXPECT_EQ(opening_reached(domain, Place{1.24, 5, 7, 10, 5, 7}), Face::x_low);
  EXPECT_EQ(opening_reached(domain, Place{-3, 5, 7}), Face::x_low) << "beyond it too";
  EXPECT_EQ(opening_reached(domain, Place{10, 0.1, 7}), std::nullopt) << "a wall or a period";
  EXPECT_EQ(opening_reached(domain, Place{10, 5, 0.1}), std::nullopt);
  EXPECT_EQ(opening_reached(domain, Place{19, 5, 14.5}), Face::z_high) << "the nearer one";
  EXPECT_EQ(opening_reached(domain, Place{19.6, 5, 14.5}), Face::x_high);
  EXPECT_EQ(opening_reached({}, Place{0, 0, 0}), std::nullopt) << "no openings";
}

double least_distance_from_the_end(const CellState& cell, const Domain& domain) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t z = 2; z < cell.position.size(); z += 3) {
    least = std::min(least, domain.size()[2] - cell.position[z]);
  }
  return least;
}

double fastest_component(const CellState& cell) {
  double most = 0;
  for (const double v : cell.velocity) most = std::max(most, std::abs(v));
  return most;
}

/// The largest force on the nodes next to the outlet; there is no body force.
double force_on_the_last_nodes(const Lattice& lattice) {
  double largest = 0;
  const int last = lattice.nodes().size(2) - 1;
  for (int y = 0; y < lattice.nodes().size(1); ++y) {
    for (int x = 0; x < lattice.nodes().size(0); ++x) {
      if (lattice.node_type(x, y, last) != kFluid) continue;
      for (const double f : lattice.force_at(x, y, last)) largest = std::max(largest, std::abs(f));
    }
  }
  return largest;
}

struct Case {
  const char* name;
  CouplingScheme scheme;
  int every;
};

class LeavingCells : public ::testing::TestWithParam<Case> {};

TEST_P(LeavingCells, GoOneByOneUntilNoneIsLeft) {
  SerialCommunicator self;
  const flow::Setup setup = capsules::leaving(GetParam().scheme, GetParam().every);
  Simulation simulation(setup, self);
  std::map<int, CellState> before;
  std::size_t known = 0;
  while (simulation.cell_count() > 0) {
    ASSERT_LT(simulation.steps_done(), 250) << "they do not get out";
    before.clear();
    for (const CellState& cell : simulation.local_cells()) before.emplace(cell.id, cell);
    simulation.step();
    ASSERT_TRUE(simulation.failures().empty()) << simulation.failures()[0].reason;
    // the lineage's forces act at vertices under way: up to what those move between two solves
    if (GetParam().scheme != CouplingScheme::lineage) {
      ASSERT_EQ(force_on_the_last_nodes(simulation.lattice()), 0) << simulation.steps_done();
    }
    for (const CellState& cell : simulation.local_cells()) {
      const bool may_leave_now = simulation.steps_done() % GetParam().every == 0;
      ASSERT_GE(least_distance_from_the_end(cell, setup.domain), may_leave_now ? 2.5 : 1.5);
    }
    for (; known < simulation.departures().size(); ++known) {
      const Departure& left = simulation.departures()[known];
      EXPECT_EQ(left.step, simulation.steps_done());
      EXPECT_EQ(left.step % GetParam().every, 0);
      EXPECT_EQ(left.face, Face::z_high);
      const CellState& cell = before.at(left.id);
      EXPECT_EQ(left.type, cell.type);
      // It left in the first solve that it could: no vertex has come nearer than it moves between two, with a
      // twentieth for what the flow changes meanwhile.
      const double way = 1.05 * fastest_component(cell) * setup.time_step * GetParam().every;
      EXPECT_LT(least_distance_from_the_end(cell, setup.domain), 2.5 + way);
      EXPECT_NEAR(left.volume, cell.volume, 0.02 * cell.volume);
    }
    EXPECT_EQ(simulation.cell_count(), 4 - static_cast<int>(known));
    EXPECT_EQ(simulation.local_cells().size(), 4 - known);
  }
  EXPECT_EQ(simulation.departures()[0].id, 1) << "the one ahead goes first";
  const std::uint64_t then = simulation.state_hash();
  for (int i = 0; i < 10; ++i) simulation.step();
  EXPECT_NE(simulation.state_hash(), then) << "the fluid goes on";
  EXPECT_TRUE(simulation.lattice().is_finite());
  EXPECT_EQ(simulation.lattice().fluid_force(), Vec3{}) << "nothing holds it any more";
  EXPECT_EQ(simulation.volume_error(), 0);
  EXPECT_EQ(simulation.minimum_gap(), std::numeric_limits<double>::infinity());
  if (GetParam().scheme != CouplingScheme::lineage) {
    EXPECT_LT(simulation.momentum_error(), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, LeavingCells,
                         ::testing::Values(Case{"Implicit", CouplingScheme::implicit, 1},
                                           Case{"EveryThirdStep", CouplingScheme::implicit, 3},
                                           Case{"Peskin", CouplingScheme::peskin, 2},
                                           Case{"Lineage", CouplingScheme::lineage, 2}),
                         [](const auto& its) { return std::string(its.param.name); });

TEST(Departures, AreForgottenByTheViscosityInside) {
  SerialCommunicator self;
  flow::Setup setup = capsules::leaving(CouplingScheme::implicit, 2);
  setup.types[0].interior_viscosity_ratio = setup.types[1].interior_viscosity_ratio = 4;
  Simulation simulation(setup, self);
  const auto inside = [&] {
    const Lattice& lattice = simulation.lattice();
    int nodes = 0;
    for (int z = 0; z < lattice.nodes().size(2); ++z) {
      for (int y = 0; y < lattice.nodes().size(1); ++y) {
        for (int x = 0; x < lattice.nodes().size(0); ++x) nodes += lattice.is_inside(x, y, z) ? 1 : 0;
      }
    }
    return nodes;
  };
  EXPECT_GT(inside(), 0);
  while (simulation.cell_count() > 0 && simulation.steps_done() < 300) simulation.step();
  EXPECT_EQ(simulation.cell_count(), 0);
  EXPECT_EQ(inside(), 0);
}

TEST(Departures, MassOfTheirOwnGoesWithThem) {
  SerialCommunicator self;
  flow::Setup setup = capsules::leaving(CouplingScheme::implicit, 1);
  setup.types[1] =
      capsules::capsule("icosphere", 1, 1.6, capsules::skalak(0.02, 2) + "membrane_density = \"1 fg/um2\"\n");
  Simulation simulation(setup, self);
  while (simulation.departures().size() < 2 && simulation.steps_done() < 250) simulation.step();
  EXPECT_EQ(simulation.departures().size(), 2u);
  EXPECT_LT(simulation.momentum_error(), 1e-10);
}

TEST(Departures, MayNotStartInAnOpening) {
  SerialCommunicator self;
  flow::Setup setup = capsules::leaving(CouplingScheme::implicit, 1);
  setup.cells[1].centre[2] = 20;
  try {
    Simulation(setup, self);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "setup: cell 1 (other) starts nearer to the opening z+ than 2.5 um, where it would leave at once; "
                 "move it away from there");
  }
}

}  // namespace
}  // namespace npfem::flow
