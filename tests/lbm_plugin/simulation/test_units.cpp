// SPDX-License-Identifier: MPL-2.0
#include "units.h"

#include <gtest/gtest.h>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

constexpr Units kUnits{0.5, 0.2, 1025.0};

TEST(Units, OfForceAreMassTimesAcceleration) {
  EXPECT_DOUBLE_EQ(kUnits.mass(), 1025.0 * 0.125);
  EXPECT_DOUBLE_EQ(kUnits.force(), kUnits.mass() * 0.5 / 0.04);
  EXPECT_DOUBLE_EQ(kUnits.force_density(), kUnits.force() / 0.125);
  EXPECT_DOUBLE_EQ(kUnits.impulse(), kUnits.force() * 0.2);
  EXPECT_DOUBLE_EQ(kUnits.pressure(), kUnits.force() / 0.25);
}

TEST(Units, OfViscosityGiveTheRelaxationTime) {
  EXPECT_DOUBLE_EQ(kUnits.kinematic_viscosity(), 1.25);
  EXPECT_DOUBLE_EQ(kUnits.relaxation_time(1.25 / 6.0), 1.0);
}

/// Extent along x of a capsule in shear after some steps, in radii, with every quantity given in units of dx, dt and
/// density.
double stretch_in_units(double dx, double dt, double density) {
  const Units units{dx, dt, density};
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {14, 14, 14}, 1.0);
  setup.domain.dx = dx;
  setup.time_step = dt;
  setup.density = density;
  setup.kinematic_viscosity *= units.kinematic_viscosity();
  setup.domain.plate_speed = 0.14 * units.velocity();
  setup.start_developed = true;
  const double shear_modulus = 0.02 * units.force() / dx;
  setup.types = {capsules::capsule("sphere", 2, 3.0 * dx, capsules::neo_hookean(shear_modulus))};
  setup.types[0].options = {{"tolerance", 1e-12 * units.force()}, {"residual_bound", 1e-6 * units.force()}};
  capsules::place(setup, 0, {7 * dx, 7 * dx, 7 * dx});
  SerialCommunicator self;
  Simulation simulation(setup, self);
  for (int i = 0; i < 100; ++i) simulation.step();
  const auto cells = simulation.local_cells();
  double extent = 0;
  for (std::size_t v = 0; v < cells[0].position.size(); v += 3) {
    extent = std::max(extent, cells[0].position[v] / dx - 7);
  }
  return extent / 3.0;
}

TEST(Units, DoNotChangeTheResult) {
  const double reference = stretch_in_units(1, 1, 1);
  EXPECT_GT(reference, 1.1);
  EXPECT_NEAR(stretch_in_units(0.4, 0.035, 1025), reference, 1e-9);
}

}  // namespace
}  // namespace npfem::flow
