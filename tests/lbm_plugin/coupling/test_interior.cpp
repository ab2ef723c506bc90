// SPDX-License-Identifier: MPL-2.0
#include "coupling/interior.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "geometry/cell_shape.h"
#include "mpi_environment.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

flow::Setup scene() {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {17, 13, 15}, 0.9);
  setup.types = {capsules::capsule("sphere", 2, 4.0, capsules::neo_hookean(0.02)),
                 capsules::capsule("sphere", 2, 2.0, capsules::neo_hookean(0.02))};
  setup.types[0].interior_viscosity_ratio = 5;
  capsules::place(setup, 0, {0.3, 6.5, 14.6});  // across the periodic edges
  capsules::place(setup, 1, {8.5, 6.5, 7.5});
  return setup;
}

template <class Visit>
void for_each_own_node(const Lattice& lattice, Visit&& visit) {
  const Box& own = lattice.nodes().own();
  for (int k = own.begin[2]; k < own.end[2]; ++k) {
    for (int j = own.begin[1]; j < own.end[1]; ++j) {
      for (int i = own.begin[0]; i < own.end[0]; ++i) {
        visit(Index3{i, j, k}, lattice.is_inside(i - own.begin[0], j - own.begin[1], k - own.begin[2]));
      }
    }
  }
}

TEST(Interior, MarksTheSameNodesOnAnyNumberOfRanks) {
  SerialCommunicator self;
  const Simulation alone(scene(), self);
  const Simulation shared(scene(), world());
  std::int64_t inside = 0;
  for_each_own_node(shared.lattice(), [&](const Index3& node, bool is_inside) {
    EXPECT_EQ(is_inside, alone.lattice().is_inside(node[0], node[1], node[2]));
    inside += is_inside ? 1 : 0;
  });
  world().sum(std::span(&inside, 1));
  const CellType type = scene().types[0];
  const double volume = enclosed_volume(type.shape, type.triangles);
  EXPECT_NEAR(static_cast<double>(inside), volume, 0.05 * volume) << "the other type has no contrast";
}

TEST(Interior, FollowsTheCells) {
  flow::Setup setup = scene();
  setup.body_force = {2e-3, 0, 0};
  Simulation simulation(setup, world());
  const auto weighted = [&] {  // sum of the x of the inside nodes: not that of the start once the cell has moved
    std::int64_t sum = 0;
    for_each_own_node(simulation.lattice(),
                      [&](const Index3& node, bool is_inside) { sum += is_inside ? node[0] : 0; });
    world().sum(std::span(&sum, 1));
    return sum;
  };
  const std::int64_t before = weighted();
  for (int i = 0; i < 60; ++i) simulation.step();
  EXPECT_NE(weighted(), before);
}

TEST(Interior, TakesNoMemoryWithoutContrast) {
  flow::Setup setup = scene();
  setup.types[0].interior_viscosity_ratio = 1;
  const Simulation simulation(setup, world());
  EXPECT_EQ(simulation.lattice().options().inside_tau, 0);
}

TEST(Interior, RefusesTwoRatios) {
  flow::Setup setup = scene();
  setup.types[1].interior_viscosity_ratio = 2;
  EXPECT_THROW(Simulation(setup, world()), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
