// SPDX-License-Identifier: MPL-2.0
// A capsule filled with a more viscous fluid gives way to a shear flow more slowly, and less.
#include <gtest/gtest.h>

#include <iostream>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "deformation.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

/// Taylor's deformation after the shear strains 0.5 and 2.
std::array<double, 2> deformations(double viscosity_ratio) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {18, 18, 14}, 0.8);
  setup.domain.plate_speed = 0.06;
  setup.start_developed = true;
  setup.types = {capsules::capsule("sphere", 2, 4.0, capsules::neo_hookean(0.004))};
  setup.types[0].interior_viscosity_ratio = viscosity_ratio;
  capsules::place(setup, 0, {9, 9, 7});
  SerialCommunicator self;
  Simulation simulation(setup, self);
  std::array<double, 2> found{};
  for (std::size_t i = 0; i < 2; ++i) {
    while (simulation.time_us() * setup.domain.plate_speed / 18 < (i == 0 ? 0.5 : 2.0)) simulation.step();
    found[i] = deformation::taylor(simulation.local_cells()[0].position, setup.types[0].triangles);
  }
  EXPECT_LT(simulation.momentum_error(), 1e-10);
  EXPECT_LT(simulation.volume_error(), 0.01);
  std::cout << "viscosity ratio " << viscosity_ratio << ": D " << found[0] << ", then " << found[1] << '\n';
  return found;
}

TEST(ViscosityInside, SlowsDownTheDeformation) {
  const auto as_outside = deformations(1), five = deformations(5), fifth = deformations(0.2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(five[i], 0.85 * as_outside[i]);
    EXPECT_GT(fifth[i], 1.02 * as_outside[i]);
  }
}

}  // namespace
}  // namespace npfem::flow
