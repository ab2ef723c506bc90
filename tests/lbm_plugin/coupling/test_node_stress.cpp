// SPDX-License-Identifier: MPL-2.0
#include "coupling/node_stress.h"

#include <gtest/gtest.h>

#include "flows.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

// In steady Couette flow every node bears nu du/dy and nothing else, whoever asks.
TEST(NodeStress, IsKnownToEveryRank) {
  const Index3 nodes{9, 10, 11};
  const Decomposition split(nodes, {true, false, true}, world().size());
  LatticeOptions options;
  options.tau = 0.8;
  Lattice lattice(world(), split, flows::plates(1, nodes[1], {-1e-5, 0, 0}, {1e-5, 0, 0}), options);
  for (int i = 0; i < 2500; ++i) {
    lattice.clear_force();
    lattice.step();
  }
  const std::vector<Index3> asked{{0, 0, 0}, {8, 9, 10}, kNoSuchNode, {4, 5, 5}, {0, 9, 3}, {8, 0, 7}};
  const auto found = stresses_at(asked, lattice, world());
  ASSERT_EQ(found.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const double shear = asked[i] == kNoSuchNode ? 0 : 0.1 * 2e-5 / 10;
    const SymmetricTensor expected{0, 0, 0, shear, 0, 0};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(found[i].viscous[k], expected[k], 1e-11);
    EXPECT_NEAR(found[i].pressure, 0, 1e-11);
  }
}

}  // namespace
}  // namespace npfem::flow
