// SPDX-License-Identifier: MPL-2.0
#include "contact/repulsion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "flows.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

constexpr RepulsionSettings kSettings{0.8, 5.0};  // um, pN

TEST(RepulsionForce, IsFullAtContactAndFadesSmoothlyToItsRange) {
  EXPECT_DOUBLE_EQ(repulsion_force(kSettings, 0), 5.0);
  EXPECT_DOUBLE_EQ(repulsion_force(kSettings, 0.4), 1.25);
  EXPECT_DOUBLE_EQ(repulsion_force(kSettings, 0.8), 0);
  EXPECT_DOUBLE_EQ(repulsion_force(kSettings, 2.0), 0);
  EXPECT_LT(repulsion_force(kSettings, 0.8 - 1e-6), 1e-10) << "the slope is continuous, too";
  EXPECT_DOUBLE_EQ(repulsion_force(kSettings, -0.8), 20.0) << "beyond a wall it grows on";
}

TEST(PairRepulsion, PushesApartAlongTheLine) {
  const Vec3 force = pair_repulsion(kSettings, {1, 1, 1}, {1, 1, 0.6}, {0, 0, 0});
  EXPECT_NEAR(force[2], 1.25, 1e-14);
  EXPECT_EQ(force[0], 0);
  EXPECT_EQ(force[1], 0);
}

TEST(PairRepulsion, IsEqualAndOppositeBitForBit) {
  const Vec3 period{7.3, 0, 5.1};
  int acting = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 a = flows::random_vector(n, 0, 20.0);
    Vec3 b = add(a, flows::random_vector(n, 1, 0.5));
    b = add(b, {(n % 5 - 2) * period[0], 0, (n % 3 - 1) * period[2]});
    const Vec3 there = pair_repulsion(kSettings, a, b, period);
    const Vec3 back = pair_repulsion(kSettings, b, a, period);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(there[axis], -back[axis]);
    acting += there != Vec3{};
  }
  EXPECT_GT(acting, 10000);
}

TEST(PairRepulsion, ActsBetweenNearestImages) {
  const Vec3 force = pair_repulsion(kSettings, {0.1, 0, 0}, {9.9, 0, 0}, {10, 10, 10});
  EXPECT_NEAR(force[0], repulsion_force(kSettings, 0.2), 1e-12);
}

TEST(PairRepulsion, GivesVerticesAtTheSamePlaceNoForce) {
  EXPECT_EQ(pair_repulsion(kSettings, {1, 2, 3}, {1, 2, 3}, {0, 0, 0}), Vec3{});
}

Setup plates_setup() {
  Setup setup;
  setup.domain.kind = DomainKind::plates;
  setup.domain.nodes = {10, 12, 10};
  setup.domain.dx = 0.5;
  setup.cell_repulsion = {0.8, 5.0};
  setup.wall_repulsion = {0.6, 3.0};
  return setup;
}

KnownVertices known_vertices(const std::vector<VertexId>& ids, const std::vector<double>& positions, double dx) {
  KnownVertices known{ids, positions, positions, {}};
  for (double& x : known.in_nodes) x /= dx;
  known.held.resize(ids.size());
  std::iota(known.held.begin(), known.held.end(), 0);
  return known;
}

TEST(Repulsion, ActsBetweenDifferentCellsOnly) {
  const flow::Setup setup = plates_setup();
  const Decomposition split(setup.domain.nodes, setup.domain.periodic(), 1);
  Repulsion repulsion(setup, split, split.box(0));
  const KnownVertices known =
      known_vertices({{0, 0}, {0, 1}, {1, 0}}, {2, 3, 2, 2.2, 3, 2, 2, 3.4, 2}, setup.domain.dx);
  std::vector<double> forces(9);
  repulsion.evaluate(known, forces);
  EXPECT_NEAR(forces[1], -1.25, 1e-12);
  EXPECT_EQ(forces[0], 0) << "the neighbour in x belongs to the same cell";
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(forces[axis] + forces[3 + axis] + forces[6 + axis], 0, 1e-14);
  EXPECT_EQ(repulsion.force_of_walls(), Vec3{});
}

TEST(Repulsion, AddsUpTheForcesOfWalls) {
  const flow::Setup setup = plates_setup();
  const Decomposition split(setup.domain.nodes, setup.domain.periodic(), 1);
  Repulsion repulsion(setup, split, split.box(0));
  const KnownVertices known = known_vertices({{0, 0}, {0, 1}}, {2, 0.3, 2, 2, 5.85, 2}, setup.domain.dx);
  std::vector<double> forces(6);
  repulsion.evaluate(known, forces);
  EXPECT_NEAR(forces[1], 3.0 * 0.25, 1e-12);
  EXPECT_NEAR(forces[4], -3.0 * 0.5625, 1e-12);
  EXPECT_NEAR(repulsion.force_of_walls()[1], 3.0 * (0.25 - 0.5625), 1e-12);
}

TEST(Repulsion, RefusesWhatARankCannotSee) {
  flow::Setup setup = plates_setup();
  const Decomposition split(setup.domain.nodes, setup.domain.periodic(), 1);
  setup.cell_repulsion.range = 1.01;
  EXPECT_THROW(Repulsion(setup, split, split.box(0)), std::invalid_argument);
  setup.cell_repulsion = {0.5, -1};
  EXPECT_THROW(Repulsion(setup, split, split.box(0)), std::invalid_argument);
  setup.cell_repulsion = {std::nan(""), 1};
  EXPECT_THROW(Repulsion(setup, split, split.box(0)), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
