// SPDX-License-Identifier: MPL-2.0
// Over a thousand steps, fluid and cells together gain no momentum but that of the body force and the walls.
#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "coupling/momentum_audit.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

using Scheme = CouplingScheme;

constexpr double kBound = 1e-10;

struct Case {
  const char* name;
  Scheme scheme;
  int steps_per_solve;
  int kernel_points;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

flow::Setup with_coupling(flow::Setup setup, const Case& c) {
  setup.coupling = {c.scheme, c.kernel_points, c.steps_per_solve};
  setup.contact.cells = {1.5, 1e-3};
  setup.contact.walls = {1.5, 1e-3};
  return setup;
}

double error_after(const flow::Setup& setup, int steps) {
  SerialCommunicator self;
  Simulation simulation(setup, self);
  for (int i = 0; i < steps; ++i) simulation.step();
  EXPECT_TRUE(simulation.failures().empty());
  std::cout << "momentum error " << simulation.momentum_error() << '\n';
  return simulation.momentum_error();
}

class MomentumAuditTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Schemes, MomentumAuditTest,
                         testing::Values(Case{"implicit", Scheme::implicit, 1, 4},
                                         Case{"implicit_every_3", Scheme::implicit, 3, 4},
                                         Case{"implicit_3_points", Scheme::implicit, 1, 3},
                                         Case{"implicit_2_points", Scheme::implicit, 1, 2},
                                         Case{"peskin", Scheme::peskin, 1, 4},
                                         Case{"peskin_every_3", Scheme::peskin, 3, 4}),
                         [](const auto& test) { return std::string(test.param.name); });

// Two cells under tension that touch, in a fluid that a body force accelerates for ever.
TEST_P(MomentumAuditTest, ClosesInAPeriodicBox) {
  flow::Setup setup = with_coupling(capsules::fluid(DomainKind::periodic_box, {16, 14, 14}, 1.0), GetParam());
  setup.body_force = {1e-6, 0, -5e-7};
  setup.types = {capsules::inflated(capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01)), 1.02)};
  capsules::place(setup, 0, {4.2, 7.1, 6.9});
  capsules::place(setup, 0, {11.1, 7.3, 7.2});
  EXPECT_LT(error_after(setup, 1000), kBound);
}

// The same cells between moving plates, so near that their kernels reach into the walls and both kinds of contact act.
TEST_P(MomentumAuditTest, ClosesBetweenWalls) {
  flow::Setup setup = with_coupling(capsules::fluid(DomainKind::shear_box, {16, 13, 12}, 1.0), GetParam());
  setup.domain.plate_speed = 0.02;
  setup.body_force = {1e-6, 2e-7, 0};
  setup.types = {capsules::inflated(capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01)), 1.02)};
  capsules::place(setup, 0, {4.2, 4.1, 6.0});
  capsules::place(setup, 0, {9.7, 8.6, 6.2});
  EXPECT_LT(error_after(setup, 1000), kBound);
}

TEST(MomentumAudit, CountsTheMassOfTheCells) {
  for (const int every : {1, 3}) {
    flow::Setup setup =
        with_coupling(capsules::fluid(DomainKind::shear_box, {14, 12, 12}, 0.8), {"", Scheme::implicit, every, 4});
    setup.domain.plate_speed = 0.05;
    setup.start_developed = true;
    setup.types = {
        capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01) + "membrane_density = \"0.3 fg/um2\"")};
    capsules::place(setup, 0, {7, 4.5, 6});
    EXPECT_LT(error_after(setup, 600), kBound) << "every " << every;
  }
}

TEST(MomentumAudit, ClosesInATubeWithoutCells) {
  flow::Setup setup = capsules::fluid(DomainKind::tube, {14, 14, 6}, 0.9);
  setup.body_force = {0, 0, 1e-4};
  EXPECT_LT(error_after(setup, 1000), 1e-13);
}

// A cell whose kernel reaches into the wall of a round tube: part of its force falls on solid nodes.
TEST(MomentumAudit, ClosesInATubeWithACell) {
  flow::Setup setup = with_coupling(capsules::fluid(DomainKind::tube, {14, 14, 12}, 0.9), {"", Scheme::implicit, 1, 4});
  setup.domain.tube_radius = 7;
  setup.body_force = {0, 0, 1e-5};
  setup.types = {capsules::inflated(capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01)), 1.02)};
  capsules::place(setup, 0, {7, 10.2, 6});
  EXPECT_LT(error_after(setup, 300), kBound);
}

// The audit must be able to fail: a force that nobody booked.
TEST(MomentumAudit, FindsAForceThatIsNotBooked) {
  SerialCommunicator self;
  const Decomposition split({8, 8, 8}, {true, true, true}, 1);
  Lattice lattice(self, split, {[](int, int, int) { return kFluid; }, {}}, {});
  MomentumAudit audit;
  audit.hold(lattice, {}, 1.0);
  audit.start(lattice);
  for (int i = 0; i < 100; ++i) {
    lattice.clear_force();
    lattice.add_force(3, 3, 3, 1e-6, 0, 0);
    lattice.step();
    audit.count_step(lattice);
  }
  EXPECT_NEAR(audit.error(lattice, self), 1e-6, 1e-8);
}

}  // namespace
}  // namespace npfem::flow
