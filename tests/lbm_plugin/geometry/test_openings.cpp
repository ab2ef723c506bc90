// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geometry/domain.h"
#include "geometry/section_flow.h"
#include "simulation/start.h"

namespace npfem::flow {
namespace {

Domain tube_with_openings() {
  Domain domain;
  domain.kind = DomainKind::tube;
  domain.nodes = {40, 40, 30};
  domain.dx = 0.5;
  domain.tube_radius = 10;
  domain.openings = {{.face = Face::z_low, .kind = Opening::Kind::velocity, .mean_velocity = 0.01},
                     {.face = Face::z_high, .kind = Opening::Kind::pressure, .pressure = 3}};
  return domain;
}

TEST(Openings, StandBeyondTheFluidOfTheirFace) {
  const Domain domain = tube_with_openings();
  EXPECT_EQ(domain.periodic(), (std::array<bool, 3>{false, false, false}));
  EXPECT_EQ(domain.node_kind({20, 20, -1}), 4);
  EXPECT_EQ(domain.node_kind({20, 20, 30}), 5);
  EXPECT_EQ(domain.node_kind({0, 0, -1}), 1) << "beyond the wall of the tube";
  EXPECT_EQ(domain.node_kind({-1, 20, -1}), 1);
  EXPECT_EQ(domain.node_kind({20, 20, 0}), 0);
}

TEST(Openings, AFaceOppositeToAnOpeningIsAWall) {
  Domain domain = tube_with_openings();
  domain.openings.pop_back();
  EXPECT_EQ(domain.node_kind({20, 20, 30}), 1);
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 10, 14}).distance, 1);
  EXPECT_EQ(domain.wall_distance({10, 10, 14}).normal, (Vec3{0, 0, -1}));
  EXPECT_DOUBLE_EQ(domain.wall_distance({10, 10, 1}).distance, 10) << "no wall at the opening";
}

TEST(Openings, DevelopedProfileIsExactBetweenPlates) {
  constexpr int n = 13;
  const std::vector<double> profile = section_flow(std::vector<bool>(n * 5, true), {n, 5}, {false, true}).profile;
  double mean = 0;
  for (int u = 0; u < n; ++u) mean += (u + 0.5) * (n - u - 0.5) / n;
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < n; ++u) {
      EXPECT_NEAR(profile[static_cast<std::size_t>(u + n * v)], (u + 0.5) * (n - u - 0.5) / mean, 1e-10);
    }
  }
}

TEST(Openings, DevelopedProfileOfATubeIsAParabola) {
  const Domain domain = tube_with_openings();
  const std::vector<double> profile = inlet_profile(domain, domain.openings[0]);
  double sum = 0, worst = 0;
  int nodes = 0;
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 40; ++i) {
      const double share = profile[static_cast<std::size_t>(i + 40 * j)];
      const double r = std::hypot(0.5 * i + 0.25 - 10, 0.5 * j + 0.25 - 10);
      EXPECT_EQ(share > 0, r < 10);
      sum += share;
      nodes += share > 0 ? 1 : 0;
      if (r < 8) worst = std::max(worst, std::abs(share - 2 * (1 - r * r / 100)));
    }
  }
  EXPECT_NEAR(sum / nodes, 1, 1e-12);
  EXPECT_LT(worst, 0.04);
}

TEST(Openings, DevelopedProfileOfASquareDuct) {
  // largest over mean velocity of a square duct: 2.0962 (Shah & London 1978)
  const std::vector<double> profile = section_flow(std::vector<bool>(40 * 40, true), {40, 40}, {false, false}).profile;
  EXPECT_NEAR(*std::max_element(profile.begin(), profile.end()), 2.0962, 0.005);
}

TEST(Openings, PlugAndUnboundedSectionsAreFlat) {
  Domain domain = tube_with_openings();
  domain.openings[0].profile = Opening::Profile::plug;
  const std::vector<double> profile = inlet_profile(domain, domain.openings[0]);
  EXPECT_EQ(profile[20 + 40 * 20], 1);
  EXPECT_EQ(profile[0], 0) << "beside the tube";
  for (const double share : section_flow(std::vector<bool>(12, true), {4, 3}, {true, true}).profile)
    EXPECT_EQ(share, 1);
}

TEST(Openings, TheLatticeIsGivenThem) {
  const Domain domain = tube_with_openings();
  const Units units{0.5, 0.1, 1000};
  const Geometry geometry = lattice_geometry(domain, units);
  ASSERT_EQ(geometry.boundaries.size(), 5u);
  const Boundary& inlet = geometry.boundaries[3];
  EXPECT_EQ(inlet.kind, Boundary::Kind::velocity);
  EXPECT_DOUBLE_EQ(inlet.velocity[2], 0.01 * 0.1 / 0.5);
  EXPECT_EQ(inlet.profile(20, 17, -1), inlet_profile(domain, domain.openings[0])[20 + 40 * 17]);
  const Boundary& outlet = geometry.boundaries[4];
  EXPECT_EQ(outlet.kind, Boundary::Kind::pressure);
  EXPECT_DOUBLE_EQ(outlet.density_deviation, 3 * 3 / 25000.0);
  EXPECT_EQ(geometry.node_type(20, 20, -1), wall(3));
  EXPECT_EQ(geometry.node_type(20, 20, 30), wall(4));
  EXPECT_EQ(geometry.node_type(0, 0, 30), wall(0));
}

}  // namespace
}  // namespace npfem::flow
