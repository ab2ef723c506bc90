// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/checkpoint_header.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "capsules.h"

namespace npfem::flow {
namespace {

TEST(CheckpointHeader, ReadsBackToTheBit) {
  CheckpointHeader header;
  header.scene = {{"domain", "0123"}, {"fluid", "4567"}};
  header.types = {{"rbc", "89ab"}};
  header.backend = "cpu-avx2";
  header.version = "0.1.0";
  header.build = "GNU";
  header.step = 123456789012;
  header.time_us = 0.1 + 0.2;
  header.wall_s = 1.0 / 3.0;
  header.counters = {5, 7, 1e-7 / 3, 0.1, 0.2, 0.3, -0.02, 0.1 / 3};
  header.failures = {{3, 0, 17, "said \"no\""}};
  header.departures = {{12, 1, 17, Face::y_high, {0.1 + 0.2, -1.0 / 3.0, 5}, 1e2 / 3}, {4, 0, 19, Face::x_low, {}, 0}};
  for (std::size_t i = 0; i < header.audit.size(); ++i) header.audit[i] = std::sqrt(static_cast<double>(i) + 0.5);
  header.audit[4] = std::numeric_limits<double>::infinity();
  const CheckpointHeader back = header_from_json(to_json(header));
  EXPECT_EQ(back.scene, header.scene);
  EXPECT_EQ(back.types, header.types);
  EXPECT_EQ(back.backend, header.backend);
  EXPECT_EQ(back.step, header.step);
  EXPECT_EQ(back.time_us, header.time_us);
  EXPECT_EQ(back.wall_s, header.wall_s);
  EXPECT_EQ(back.counters.worst_residual_pN, header.counters.worst_residual_pN);
  EXPECT_EQ(back.counters.least_gap_um, header.counters.least_gap_um);
  EXPECT_EQ(back.counters.worst_volume_error, header.counters.worst_volume_error);
  header.counters.least_gap_um = std::numeric_limits<double>::infinity();
  EXPECT_EQ(header_from_json(to_json(header)).counters.least_gap_um, header.counters.least_gap_um);
  ASSERT_EQ(back.failures.size(), 1u);
  EXPECT_EQ(back.failures[0].reason, "said \"no\"");
  EXPECT_EQ(back.departures, header.departures);
  EXPECT_EQ(back.audit[5], header.audit[5]);
  EXPECT_TRUE(std::isnan(back.audit[4])) << "JSON knows no infinity";
}

TEST(CheckpointHeader, NamesDifferences) {
  const CheckpointHeader::Marks a{{"domain", "1"}, {"fluid", "2"}, {"flow", "3"}};
  EXPECT_EQ(differences(a, a), "");
  EXPECT_EQ(differences(a, {{"domain", "1"}, {"fluid", "9"}, {"cells", "4"}}), "[fluid], [flow], [cells]");
}

TEST(CheckpointHeader, ATypeIsKnownByAllThatMovesIt) {
  const CellType type = capsules::capsule("sphere", 2, 2.6, capsules::neo_hookean(0.02));
  const std::string mark = mark_of(type);
  EXPECT_EQ(mark_of(capsules::capsule("sphere", 2, 2.6, capsules::neo_hookean(0.02))), mark);
  EXPECT_NE(mark_of(capsules::capsule("sphere", 2, 2.7, capsules::neo_hookean(0.02))), mark);
  EXPECT_NE(mark_of(capsules::capsule("icosphere", 2, 2.6, capsules::neo_hookean(0.02))), mark);
  CellType other = type;
  other.material = "shear_modulus = 3";
  EXPECT_NE(mark_of(other), mark);
  other = type;
  other.options[0].second *= 2;
  EXPECT_NE(mark_of(other), mark);
}

}  // namespace
}  // namespace npfem::flow
