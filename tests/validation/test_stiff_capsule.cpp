// SPDX-License-Identifier: MPL-2.0
// Stability whatever the stiffness: membranes that resist change of area a thousand times more than shear, and capsules
// as good as rigid, where the explicit coupling blows up at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "deformation.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

/// A capsule of radius 4 in a box of 6 radii, Ca of its shear modulus, Skalak's C.
flow::Setup stiff(CouplingScheme scheme, double tau, double capillary, double skalak_c, double reynolds,
                  int every = 1) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {24, 24, 24}, tau);
  const double rate = reynolds * setup.kinematic_viscosity / 16;
  setup.domain.plate_speed = 24 * rate;
  setup.start_developed = true;
  setup.coupling = {scheme, 4, every};
  const double shear_modulus = setup.kinematic_viscosity * rate * 4 / capillary;
  setup.types = {capsules::capsule("icosphere", 2, 4, capsules::skalak(shear_modulus, skalak_c))};
  const double force = shear_modulus * (1 + 2 * skalak_c) * 4;
  setup.types[0].options = {{"tolerance", 1e-10 * force}, {"residual_bound", 1e-3 * force}};
  capsules::place(setup, 0, {12, 12, 12});
  return setup;
}

/// Steps done before a cell was lost.
int steps_survived(const flow::Setup& setup, int most, double* deformation = nullptr, double* slip = nullptr) {
  SerialCommunicator self;
  Simulation simulation(setup, self);
  for (int i = 0; i < most; ++i) {
    simulation.step();
    if (!simulation.failures().empty()) return i;
  }
  const CellState cell = simulation.local_cells()[0];
  if (deformation) *deformation = deformation::taylor(cell.position, setup.types[0].triangles);
  if (slip) {
    *slip = 0;
    for (const double v : cell.velocity) *slip = std::max(*slip, std::abs(v));
  }
  return most;
}

TEST(StiffCapsule, ImplicitCouplingStandsWhereTheExplicitBlowsUp) {
  double deformation = 0;
  EXPECT_EQ(steps_survived(stiff(CouplingScheme::implicit, 2, 0.3, 1000, 0.2), 300, &deformation), 300);
  EXPECT_LT(deformation, 0.3);
  const int explicit_steps = steps_survived(stiff(CouplingScheme::peskin, 2, 0.3, 1000, 0.2), 300);
  std::cout << "Skalak C = 1000: implicit D " << deformation << " after 300 steps, explicit lost after "
            << explicit_steps << '\n';
  EXPECT_LT(explicit_steps, 100);
}

// Ca = 3e-7, over the range of relaxation times and of steps between solves that the ambient layer ell(delta) is made
// for. A sphere that cannot deform turns with the flow: no vertex is faster than the flow around it.
TEST(StiffCapsule, RigidLimitIsStable) {
  for (const auto& [tau, every] : {std::pair{1.0, 1}, std::pair{1.0, 5}, std::pair{4.0, 2}, std::pair{12.0, 1}}) {
    double deformation = 1, fastest = 1;
    const flow::Setup setup = stiff(CouplingScheme::implicit, tau, 3e-7, 1, 0.02, every);
    EXPECT_EQ(steps_survived(setup, 150, &deformation, &fastest), 150) << "tau " << tau << ", every " << every;
    std::cout << "rigid, tau " << tau << ", k " << every << ": D " << deformation << ", fastest vertex "
              << fastest / setup.domain.plate_speed << " of the plates\n";
    EXPECT_LT(deformation, 1e-3);
    EXPECT_LT(fastest, 0.2 * setup.domain.plate_speed);
  }
}

}  // namespace
}  // namespace npfem::flow
