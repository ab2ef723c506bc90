// SPDX-License-Identifier: MPL-2.0
#include "immersed_boundary/stencil.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "flows.h"

namespace npfem::flow {
namespace {

template <int Points>
void expect_centred_on(const Vec3& position) {
  const Stencil<Points> stencil(position);
  const Index3 node = node_at(position);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double centre = 0;
    for (int p = 0; p < Points; ++p) {
      const int i = stencil.first[axis] + p;
      EXPECT_LE(std::abs(i - node[axis]), 2) << "out of the halo";
      centre += stencil.weight[axis][static_cast<std::size_t>(p)] * (i + 0.5);
    }
    EXPECT_NEAR(centre, position[axis], 1e-13);
  }
}

TEST(Stencil, LiesAroundTheVertexAndWithinTheHalo) {
  for (int n = 0; n < 2000; ++n) {
    const Vec3 position = flows::random_vector(n, 0, 20.0);
    expect_centred_on<2>(position);
    expect_centred_on<3>(position);
    expect_centred_on<4>(position);
  }
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
    expect_centred_on<2>({x, x, x});
    expect_centred_on<3>({x, x, x});
    expect_centred_on<4>({x, x, x});
  }
}

TEST(Stencil, FindsTheNodeThatStandsForAPosition) {
  const Decomposition split({8, 5, 7}, {true, false, true}, 1);
  EXPECT_EQ(node_in_grid(split, {-0.1, 2.5, 15.2}), (Index3{7, 2, 1}));
  EXPECT_EQ(node_in_grid(split, {8.0, -3.0, 0.0}), (Index3{0, 0, 0}));
  EXPECT_EQ(node_in_grid(split, {0.0, 5.0, 6.99}), (Index3{0, 4, 6}));
  EXPECT_EQ(node_in_grid(split, {0.0, 1e300, 0.0})[1], 4) << "a vertex lost far beyond a wall has a node";
}

}  // namespace
}  // namespace npfem::flow
