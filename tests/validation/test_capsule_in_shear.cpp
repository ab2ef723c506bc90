// SPDX-License-Identifier: MPL-2.0
// A neo-Hookean capsule, spherical at rest, in simple shear: Taylor's deformation over time at Ca = mu gdot a / G_s =
// 0.3, viscosity ratio 1, against the high-resolution curve of Huet & Wachs, J. Comput. Phys. (2023), and the implicit
// coupling against the explicit one on the same grid.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "coupling/limits.h"
#include "deformation.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

constexpr double kReferenceD = 0.3123;  // at gdot t = 1

struct ShearRun {
  double radius;     // node spacings
  int box;           // node spacings
  int mesh_level;    // of the icosphere
  double capillary;  // Ca
  double reynolds;   // gdot a^2 / nu
  CouplingScheme scheme = CouplingScheme::implicit;
  int steps_per_solve = 1;
  int kernel_points = 4;
};

struct ShearResult {
  double deformation, volume, kappa;
};

/// To gdot t = `time`, at tau = 4.
ShearResult sheared(const ShearRun& run, double time = 1) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {run.box, run.box, run.box}, 4.0);
  const double rate = run.reynolds * setup.kinematic_viscosity / (run.radius * run.radius);
  setup.domain.plate_speed = rate * run.box;
  setup.start_developed = true;
  setup.coupling = {run.scheme, run.kernel_points, run.steps_per_solve};
  const double shear_modulus = setup.kinematic_viscosity * rate * run.radius / run.capillary;
  setup.types = {capsules::capsule("icosphere", run.mesh_level, run.radius, capsules::neo_hookean(shear_modulus))};
  setup.types[0].options = {{"tolerance", 1e-7 * shear_modulus * run.radius}, {"residual_bound", 1e-3}};
  const double middle = 0.5 * run.box;
  capsules::place(setup, 0, {middle, middle, middle});

  SerialCommunicator self;
  Simulation simulation(setup, self);
  const auto steps = std::lround(time / rate);
  for (long i = 0; i < steps && simulation.failures().empty(); ++i) simulation.step();
  EXPECT_TRUE(simulation.failures().empty());
  EXPECT_LT(simulation.momentum_error(), 1e-10);
  const CellState cell = simulation.local_cells()[0];
  double kappa = 0;
  for (const Limit& limit : accuracy_limits(setup, 0, rate)) {
    if (limit.name.starts_with("kappa_shear")) kappa = limit.value;
  }
  const double rest_volume = deformation::solid(setup.types[0].shape, setup.types[0].triangles).volume;
  return {deformation::taylor(cell.position, setup.types[0].triangles), cell.volume / rest_volume, kappa};
}

void print(const char* name, const ShearResult& result) {
  std::cout << name << ": D " << result.deformation << ", volume " << 100 * (result.volume - 1) << " %, kappa "
            << result.kappa << '\n';
}

TEST(CapsuleInShear, DeformsAsPublished) {
  const ShearResult result = sheared({6, 48, 3, 0.3, 0.05});
  print("implicit, box 8 a", result);
  EXPECT_NEAR(result.deformation, kReferenceD, 0.05 * kReferenceD);
  EXPECT_NEAR(result.volume, 1, 0.01);
}

// The compliance of the implicit coupling is kappa; below 0.002 it must not show. What both lose in volume is the
// compressibility of the lattice fluid.
TEST(CapsuleInShear, ImplicitCouplingAgreesWithExplicit) {
  for (const int every : {1, 3}) {
    ShearRun run{5, 30, 3, 0.3, 0.02};
    run.steps_per_solve = every;
    const ShearResult implicit = sheared(run);
    run.scheme = CouplingScheme::peskin;
    const ShearResult peskin = sheared(run);
    std::cout << "every " << every << '\n';
    print("  implicit", implicit);
    print("  peskin", peskin);
    EXPECT_LT(implicit.kappa, 0.002);
    EXPECT_NEAR(implicit.deformation, peskin.deformation, 0.005 * peskin.deformation);
    EXPECT_NEAR(implicit.volume, peskin.volume, 0.002);
    EXPECT_LT(peskin.volume - implicit.volume, 0.001);
  }
}

// A membrane that slips through the fluid goes on losing volume; one that is only compliant does so once.
TEST(CapsuleInShear, DoesNotLeak) {
  ShearRun run{4, 24, 2, 0.3, 0.02};
  const ShearResult implicit = sheared(run, 4);
  run.scheme = CouplingScheme::peskin;
  const ShearResult peskin = sheared(run, 4);
  print("implicit, gdot t = 4", implicit);
  print("peskin,   gdot t = 4", peskin);
  EXPECT_LT(peskin.volume - implicit.volume, 0.001);
}

TEST(CapsuleInShear, KernelsAgree) {
  ShearRun run{4, 24, 2, 0.3, 0.02};
  const ShearResult four = sheared(run);
  run.kernel_points = 3;
  const ShearResult three = sheared(run);
  print("4 points", four);
  print("3 points", three);
  EXPECT_NEAR(three.deformation, four.deformation, 0.02 * four.deformation);
}

}  // namespace
}  // namespace npfem::flow
