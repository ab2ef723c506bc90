// SPDX-License-Identifier: MPL-2.0
// The scheme kept for comparison: what it samples, what it keeps and what it does not.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "deformation.h"
#include "geometry/vertex_patches.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

constexpr const char* kDensity = "membrane_density = \"1.5 fg/um2\"\n";
// What acts on the cell keeps no volume: the fluid inside is not asked.
constexpr const char* kVolume = "global_volume_modulus = \"0.1 Pa\"\nglobal_volume_form = \"exact\"\n";

flow::Setup capsule_in_shear(CouplingScheme scheme, double modulus, const char* density) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {20, 20, 16}, 1.0);
  setup.domain.plate_speed = 0.04;
  setup.start_developed = true;
  setup.coupling.scheme = scheme;
  setup.coupling.inset = 0;  // as the lineage couples: at the vertices
  setup.types = {capsules::capsule("sphere", 2, 4.0, capsules::skalak(modulus, 1) + kVolume + density)};
  capsules::place(setup, 0, {10, 10, 8});
  return setup;
}

TEST(VertexPatches, OfASphere) {
  const CellType sphere = capsules::capsule("icosphere", 2, 3.0, capsules::neo_hookean(0.01));
  double area = 0;
  const auto patches = vertex_patches(sphere.shape, sphere.triangles);
  for (std::size_t v = 0; v < patches.size(); ++v) {
    area += patches[v].area;
    const Vec3 outwards = scale(1 / 3.0, {sphere.shape[3 * v], sphere.shape[3 * v + 1], sphere.shape[3 * v + 2]});
    EXPECT_NEAR(dot(patches[v].normal, outwards), 1, 2e-3);
  }
  EXPECT_NEAR(area, sphere.model->measure("rest_area"), 1e-9);
}

TEST(Lineage, LeavesACellAtRestAlone) {
  SerialCommunicator self;
  flow::Setup setup = capsules::fluid(DomainKind::periodic_box, {12, 12, 12}, 1.0);
  setup.coupling.scheme = CouplingScheme::lineage;
  setup.types = {capsules::capsule("sphere", 2, 3.0, capsules::neo_hookean(0.01) + kDensity)};
  capsules::place(setup, 0, {5.3, 6.1, 7.7});
  Simulation simulation(setup, self);
  const std::vector<double> before = simulation.local_cells()[0].position;
  for (int i = 0; i < 100; ++i) simulation.step();
  const std::vector<double> after = simulation.local_cells()[0].position;
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-10);
}

/// Measured: D = 0.2309 by the implicit coupling and 0.1950 by this one, which takes the traction of the fluid from
/// nodes farther out, where the disturbance is less.
TEST(Lineage, DeformsACapsuleInShearAlmostAsTheImplicitCouplingDoes) {
  const auto run = [](CouplingScheme scheme, const char* density) {
    SerialCommunicator self;
    const flow::Setup setup = capsule_in_shear(scheme, 0.01, density);
    Simulation simulation(setup, self);
    for (int i = 0; i < 900; ++i) simulation.step();
    EXPECT_TRUE(simulation.failures().empty());
    const double deformation = deformation::taylor(simulation.local_cells()[0].position, setup.types[0].triangles);
    std::cout << "D " << deformation << ", volume error " << simulation.volume_error() << ", momentum error "
              << simulation.momentum_error() << '\n';
    return std::pair(deformation, simulation.momentum_error());
  };
  const auto [implicit, closed] = run(CouplingScheme::implicit, "");
  const auto [lineage, open] = run(CouplingScheme::lineage, kDensity);
  EXPECT_NEAR(implicit, 0.231, 0.005);
  EXPECT_NEAR(lineage / implicit, 0.845, 0.02);
  EXPECT_LT(closed, 1e-10);
  EXPECT_GT(open, 1e-6) << "the forces on fluid and cell are not each other's opposite";
}

TEST(Lineage, RefusesACellWithoutMass) {
  SerialCommunicator self;
  EXPECT_THROW(Simulation(capsule_in_shear(CouplingScheme::lineage, 0.01, ""), self), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
