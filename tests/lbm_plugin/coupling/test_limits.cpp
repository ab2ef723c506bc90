// SPDX-License-Identifier: MPL-2.0
#include "coupling/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <tuple>

#include "capsules.h"

namespace npfem::flow {
namespace {

const Limit& limit(const std::vector<Limit>& limits, const std::string& name) {
  for (const Limit& l : limits) {
    if (l.name == name) return l;
  }
  throw std::out_of_range(name);
}

/// A red cell's modulus and size at dx = 0.5 um in plasma, tau = 12, worked out by hand.
flow::Setup worked_example(int steps_per_solve) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {32, 32, 32}, 1.0);
  setup.domain.dx = 0.5;
  setup.density = 1025;
  setup.kinematic_viscosity = 1.2;
  setup.time_step = 23.0 / 6.0 * 0.25 / 1.2;  // tau = 12
  setup.coupling.steps_per_solve = steps_per_solve;
  setup.types = {capsules::capsule("icosphere", 3, 4.0, capsules::skalak(5.5, 10))};
  return setup;
}

TEST(Limits, AgreeWithTheWorkedExample) {
  const auto once = accuracy_limits(worked_example(1), 0.05, 1e-3);
  EXPECT_NEAR(limit(once, "tau").value, 12.0, 1e-9);
  EXPECT_NEAR(limit(once, "kappa_shear capsule").value, 1e-4, 0.1e-4);
  EXPECT_NEAR(limit(once, "compression capsule").value, 0.010, 0.001);
  EXPECT_NEAR(limit(once, "gdot_T").value, 1e-3 * 9.2, 0.1e-3);
  const auto every_5 = accuracy_limits(worked_example(5), 0.05, 1e-3);
  EXPECT_NEAR(limit(every_5, "kappa_shear capsule").value, 1.3e-3, 0.1e-3);
  EXPECT_EQ(limit(every_5, "kappa_shear capsule").verdict, Verdict::good);
  const auto every_20 = accuracy_limits(worked_example(20), 0.05, 1e-3);
  EXPECT_NEAR(limit(every_20, "kappa_shear capsule").value, 0.011, 0.001);
  EXPECT_EQ(limit(every_20, "kappa_shear capsule").verdict, Verdict::exceeded);
}

TEST(Limits, JudgeByTheBounds) {
  const auto limits = accuracy_limits(worked_example(1), 0.05, 1e-3);
  EXPECT_EQ(limit(limits, "compression capsule").verdict, Verdict::fair);
  EXPECT_EQ(limit(limits, "gdot_T").verdict, Verdict::good);
  EXPECT_EQ(limit(accuracy_limits(worked_example(1), 0.05, 3e-3), "gdot_T").verdict, Verdict::exceeded);
  EXPECT_EQ(limit(accuracy_limits(worked_example(1), 1.0, 0), "Ma").verdict, Verdict::exceeded);
  for (const Limit& l : limits) EXPECT_FALSE(l.advice.empty()) << l.name;
}

TEST(Limits, KnowWhereVerticesAreTooFarApartForTheKernel) {
  // 642 vertices on a sphere of 4 um: 0.6 um apart, 1.2 nodes.
  flow::Setup setup = worked_example(1);
  for (const auto& [points, ratio, verdict] : {std::tuple{4, 0.60, Verdict::good}, std::tuple{3, 0.80, Verdict::good},
                                               std::tuple{2, 1.20, Verdict::exceeded}}) {
    setup.coupling.kernel_points = points;
    const auto limits = accuracy_limits(setup, 0, 0);
    EXPECT_NEAR(limit(limits, "spacing capsule").value, ratio, 0.01);
    EXPECT_EQ(limit(limits, "spacing capsule").verdict, verdict);
  }
}

TEST(Limits, KnowWhereTheFlowPressesCellsIntoEachOther) {
  // Plasma at 2000 1/s: 1.2e-3 Pa s * 1.025 * 2000 1/s = 2.46 Pa.
  flow::Setup setup = worked_example(1);
  for (const auto& [strength, verdict] :
       {std::tuple{100.0, Verdict::good}, std::tuple{40.0, Verdict::fair}, std::tuple{20.0, Verdict::exceeded}}) {
    setup.contact.cells = {0.5, strength, 0, 0};
    const auto limits = accuracy_limits(setup, 0.05, 2e-3);
    EXPECT_NEAR(limit(limits, "contact").value, 2.46 / strength, 1e-9);
    EXPECT_EQ(limit(limits, "contact").verdict, verdict);
  }
  setup.contact.cells.range = 0;
  EXPECT_THROW(limit(accuracy_limits(setup, 0.05, 2e-3), "contact"), std::out_of_range);
}

TEST(Limits, AreThoseOfTheCouplingInUse) {
  flow::Setup setup = worked_example(1);
  setup.coupling.scheme = CouplingScheme::peskin;
  EXPECT_THROW(limit(accuracy_limits(setup, 0, 0), "kappa_shear capsule"), std::out_of_range);
  setup.types.clear();
  EXPECT_EQ(accuracy_limits(setup, 0, 0).size(), 3u);
}

TEST(Limits, AreNotJudgedWhereTheFlowIsUnknown) {
  const auto limits = accuracy_limits(worked_example(1), std::nullopt, std::nullopt);
  for (const char* name : {"Ma", "gdot_T"}) {
    EXPECT_EQ(limit(limits, name).verdict, Verdict::unknown);
    EXPECT_TRUE(std::isnan(limit(limits, name).value));
  }
  EXPECT_EQ(verdict_name(Verdict::unknown), "unknown");
}

TEST(Limits, ScaleWithTheModulus) {
  const auto limits = accuracy_limits(worked_example(1), 0, 0);
  const auto model = worked_example(1).types[0].model;
  EXPECT_NEAR(limit(limits, "kappa_largest capsule").value / limit(limits, "kappa_shear capsule").value,
              model->measure("largest_modulus") / model->measure("shear_modulus"), 1e-9);
}

}  // namespace
}  // namespace npfem::flow
