// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "cells.h"
#include "error.h"

namespace npfem {
namespace {

TEST(SolverOptions, RoundTripAndRange) {
  SolverOptions options;
  for (const OptionInfo& info : solver_options()) {
    const double before = get_option(options, info.key);
    EXPECT_GE(before, info.least);
    EXPECT_LE(before, info.largest);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(set_option(options, info.key, nan), Error) << info.key;
    EXPECT_THROW(set_option(options, info.key, info.least - 1), Error) << info.key;
    EXPECT_EQ(get_option(options, info.key), before);
    set_option(options, info.key, info.least);
    EXPECT_EQ(get_option(options, info.key), info.least);
  }
}

TEST(SolverOptions, NamesTheNearestKey) {
  SolverOptions options;
  try {
    set_option(options, "tolerence", 1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::unknown_name);
    EXPECT_NE(std::string(e.what()).find("did you mean \"tolerance\""), std::string::npos);
  }
}

TEST(SolverOptions, WholeNumbersOnlyWhereTheyCount) {
  SolverOptions options;
  EXPECT_THROW(set_option(options, "max_iterations", 2.5), Error);
}

/// A cell carried by a shear flow, then relaxed under a pair of loads: what it is afterwards depends on every option.
std::uint64_t outcome(const SolverOptions& options, const char* backend) {
  Material material = Material::preset("palabos-rbc");
  Batch batch(std::make_shared<const Model>(build_model(evans_fung_cell(2), material)), backend, 1);
  batch.options() = options;
  auto force = testing::get(batch, Field::position);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = i % 3 == 0 ? 8 * force[i] : 0;
  batch.write(Field::external_force, 0, 1, force);
  for (int s = 0; s < 4; ++s) batch.step(1);
  std::uint64_t hash = batch.state_hash(0) ^ static_cast<std::uint64_t>(batch.report(0).status);
  double mean = 0;
  for (std::size_t i = 0; i < force.size(); i += 3) mean += force[i] / static_cast<double>(force.size() / 3);
  for (std::size_t i = 0; i < force.size(); i += 3) force[i] -= mean;
  batch.write(Field::external_force, 0, 1, force);
  if (!options.lineage) {
    batch.relax();
    hash = hash * 31 + batch.state_hash(0);
  }
  return hash;
}

TEST(SolverOptions, EachChangesTheResult) {
  const std::map<std::string, double> changed{
      {"time_step", 0.5},     {"integrator", 1},       {"tolerance", 1e3},      {"residual_bound", 0},
      {"max_iterations", 2},  {"relax_iterations", 3}, {"history", 1},          {"newton_iterations", 1},
      {"max_line_search", 1}, {"lineage_alpha", 0.5},  {"lineage_beta", 0.1},   {"lineage_tolerance", 1e-2},
      {"lineage_window", 3},  {"lineage_attempts", 1}, {"lineage_armijo", 0.9}, {"lineage_curvature", 0.01},
      {"precision", 1},       {"matrix", 1},           {"lone_cells", 1}};
  for (const OptionInfo& info : solver_options()) {
    if (std::string(info.key) == "threads") continue;  // changes nothing: cpu/test_determinism.cpp
    const std::string doc = info.doc;
    const char* const backend = doc.starts_with("back end cpu") ? "cpu" : "reference";
    SolverOptions options;
    options.lineage = std::string(info.key).starts_with("lineage");
    options.time_step = 20;
    if (std::string(info.key) == "residual_bound")
      options.max_iterations = 2, options.newton_iterations = 0, options.residual_bound = 1e6;
    if (std::string(info.key) == "newton_iterations") options.max_iterations = 2;
    if (std::string(info.key) == "lineage_attempts") options.lineage_armijo = 1;  // no search can succeed
    const std::uint64_t before = outcome(options, backend);
    ASSERT_TRUE(changed.contains(info.key)) << info.key;
    set_option(options, info.key, changed.at(info.key));
    EXPECT_NE(outcome(options, backend), before) << info.key;
  }
}

}  // namespace
}  // namespace npfem
