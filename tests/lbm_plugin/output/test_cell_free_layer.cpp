// SPDX-License-Identifier: MPL-2.0
#include "output/cell_free_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cell_shapes.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

CellState at(const CellType& type, int id, const Vec3& centre) {
  CellState cell{};
  cell.id = id;
  cell.position = type.shape;
  for (std::size_t n = 0; n < cell.position.size(); ++n) cell.position[n] += centre[n % 3];
  return cell;
}

/// The cells dealt out over the ranks.
double layer(const Domain& domain, const std::vector<CellState>& all) {
  std::vector<CellState> own;
  for (const CellState& cell : all) {
    if (cell.id % world().size() == world().rank()) own.push_back(cell);
  }
  return cell_free_layer(domain, own, world());
}

TEST(CellFreeLayer, OfABlockOfVertices) {
  // vertices 0.5 um apart fill the box but for 1.25 um at the lower and 2.25 um at the upper plate
  Domain domain{DomainKind::plates, {16, 20, 16}, 0.5, 0, 0};
  CellState block{};
  for (double x = 0.25; x < 8; x += 0.5) {
    for (double y = 1.25; y < 8; y += 0.5) {
      for (double z = 0.25; z < 8; z += 0.5) {
        for (const double c : {x + 16, y, z - 24}) block.position.push_back(c);  // some periods away
      }
    }
  }
  EXPECT_NEAR(layer(domain, {block}), 0.5 * (1.25 + 2.25), 1e-12);
}

TEST(CellFreeLayer, OfACylinderInATube) {
  Domain domain{DomainKind::tube, {40, 40, 20}, 0.5, 10, 0};
  CellState core{};
  for (int turn = 0; turn < 360; ++turn) {
    for (double z = 0.1; z < 10; z += 0.4) {
      const double angle = turn * 0.01745329251994;
      for (const double c : {10 + 7.5 * std::cos(angle), 10 + 7.5 * std::sin(angle), z}) core.position.push_back(c);
    }
  }
  EXPECT_NEAR(layer(domain, {core}), 2.5, 1e-9);
}

TEST(CellFreeLayer, CountsPatchesWithACellOnly) {
  Domain domain{DomainKind::shear_box, {40, 20, 40}, 0.5, 0, 0};
  const CellType sphere = testing::sphere(1, 3);
  const double one = layer(domain, {at(sphere, 0, {5, 3, 5})});
  EXPECT_GT(one, 1.99);
  EXPECT_LT(one, 3);
  EXPECT_NEAR(layer(domain, {at(sphere, 0, {5, 3, 5}), at(sphere, 1, {25, 23 - 20, 15}), at(sphere, 2, {11, 7, 11})}),
              one, 0.2);
  EXPECT_TRUE(std::isnan(layer(domain, {})));
  domain.kind = DomainKind::periodic_box;
  EXPECT_TRUE(std::isnan(layer(domain, {at(sphere, 0, {5, 3, 5})})));
}

}  // namespace
}  // namespace npfem::flow
