// SPDX-License-Identifier: MPL-2.0
#include "geometry/channel_flow.h"

#include <gtest/gtest.h>

#include <numbers>

namespace npfem::flow {
namespace {

Domain plates(int nodes_across) {
  Domain domain;
  domain.kind = DomainKind::plates;
  domain.nodes = {24, nodes_across, 10};
  domain.dx = 0.5;
  return domain;
}

/// Plane Poiseuille flow: mean velocity H^2 G/(12 mu), 3/2 of it in the middle, 6 U/H at the walls.
TEST(ChannelFlow, OfPlatesIsThatOfPoiseuille) {
  const ChannelFlow flow = channel_flow(plates(24), 0).value();
  const double height = 12, area = height * 5;
  EXPECT_DOUBLE_EQ(flow.widest_area, area);
  EXPECT_DOUBLE_EQ(flow.narrowest_area, area);
  EXPECT_NEAR(flow.resistance, 12.0 * 12 / (height * height * area), 0.01 * 12.0 * 12 / (height * height * area));
  EXPECT_NEAR(flow.fastest * area, 1.5, 0.01);
  EXPECT_NEAR(flow.steepest * area, 6 / height, 0.05 * 6 / height);
  EXPECT_NEAR(flow.rate_under(3, 1200), 3 / (1200 * flow.resistance), 1e-15);
}

/// Of a tube: 2 U on the axis, 4 U/R at the wall.
TEST(ChannelFlow, OfAConstrictionIsThatOfItsThroat) {
  Domain tube;
  tube.kind = DomainKind::tube;
  tube.nodes = {32, 32, 60};
  tube.dx = 0.5;
  tube.tube_radius = 8;
  const double plain = channel_flow(tube, 2).value().resistance;
  tube.solids.emplace_back(Constriction({2, true, {8, 8, 15}, 14, 8, 4}));
  const ChannelFlow flow = channel_flow(tube, 2).value();
  const double throat = std::numbers::pi * 16;
  EXPECT_NEAR(flow.widest_area, 4 * throat, 0.02 * 4 * throat);
  EXPECT_NEAR(flow.narrowest_area, throat, 0.05 * throat);
  EXPECT_NEAR(flow.fastest * throat, 2, 0.1);
  EXPECT_NEAR(flow.steepest * throat, 1, 0.15);
  EXPECT_GT(flow.resistance, 2 * plain);
  EXPECT_LT(flow.resistance, 16 * plain);
}

TEST(ChannelFlow, IsUnknownWhereAWallClosesIt) {
  Domain closed = plates(24);
  closed.solids.emplace_back(BoxSolid{{6, 6, 2.5}, {1, 6, 2.5}});
  EXPECT_FALSE(channel_flow(closed, 0).has_value());
  EXPECT_TRUE(channel_flow(closed, 2).has_value()) << "beside it";
}

}  // namespace
}  // namespace npfem::flow
