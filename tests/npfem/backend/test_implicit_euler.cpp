// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "cells.h"
#include "error.h"
#include "random_shape.h"

namespace npfem {
namespace {

using testing::get;
using testing::uniform;

/// By back end.
class ImplicitEuler : public ::testing::TestWithParam<const char*> {
 protected:
  const char* back_end = GetParam();
};
INSTANTIATE_TEST_SUITE_P(BackEnds, ImplicitEuler, ::testing::Values("reference", "cpu"));

TEST_P(ImplicitEuler, FreeFlightKeepsMomentumAndShape) {
  Material material = Material::preset("rbc");
  material.set("membrane_density", 5);
  material.set("stress_free_reduced_volume", 0);
  Batch batch(std::make_shared<const Model>(build_model(evans_fung_cell(2), material)), back_end, 1);
  const auto start = get(batch, Field::position);
  batch.write(Field::velocity, 0, 1, uniform(batch.model(), 0.01, -0.02, 0.03));
  ASSERT_EQ(batch.step(100), 0);
  const double flown = 100 * batch.options().time_step;
  const auto x = get(batch, Field::position);
  for (std::size_t i = 0; i < x.size(); i += 3) {
    EXPECT_NEAR(x[i] - start[i], 0.01 * flown, 1e-11);
    EXPECT_NEAR(x[i + 1] - start[i + 1], -0.02 * flown, 1e-11);
  }
}

TEST_P(ImplicitEuler, ConstantForceGivesTheDiscreteParabola) {
  // v_n = n dt f/m and x_n = x_0 + dt sum v: exact for implicit Euler.
  Batch batch(testing::red_cell_model(2, 5), back_end, 1);
  batch.relax();
  const double before = batch.measure("centre_z", 0);
  batch.write(Field::external_force, 0, 1, uniform(batch.model(), 0, 0, -2));
  const int n = batch.model().num_vertices();
  ASSERT_EQ(batch.step(40), 0);
  const auto mass = batch.model().solid_mass;
  double momentum = 0;
  const auto v = get(batch, Field::velocity);
  for (std::size_t i = 0; i < mass.size(); ++i) momentum += mass[i] * v[3 * i + 2];
  const double dt = batch.options().time_step;
  EXPECT_NEAR(momentum, -2.0 * n * 40 * dt, 1e-9 * std::abs(momentum));
  EXPECT_LT(batch.measure("centre_z", 0), before);
}

TEST_P(ImplicitEuler, DampsAVibrationAsTheoryDemands) {
  // Breathing of an icosahedron held by its volume alone: one linear mode of frequency w. Implicit Euler multiplies the
  // amplitude of (x, v) by 1/(1 - i w dt) in each step: magnitude (1 + w^2 dt^2)^-1/2, phase atan(w dt).
  Material material;
  material.set("global_volume_modulus", 1000);
  material.set("membrane_density", 3);
  const auto model = std::make_shared<const Model>(build_model(icosahedral_sphere(0), material));
  Batch batch(model, back_end, 1);
  batch.options().tolerance = 0;  // as far as rounding lets it go
  const double dt = batch.options().time_step = 0.005;
  const double amplitude = 1e-6;
  auto x = get(batch, Field::position);
  const auto rest = x;
  for (double& c : x) c *= 1 + amplitude;
  batch.write(Field::position, 0, 1, x);
  batch.evaluate();
  const auto force = get(batch, Field::elastic_force);
  const double stiffness = -(force[0] * rest[0] + force[1] * rest[1] + force[2] * rest[2]) / amplitude;
  const double w = std::sqrt(stiffness / model->solid_mass[0]);
  ASSERT_NEAR(w * dt, 0.15, 0.05);
  batch.step(10);
  const auto moved = get(batch, Field::position);
  const double ratio = (moved[0] * rest[0] + moved[1] * rest[1] + moved[2] * rest[2] - 1) / amplitude;
  const double decay = std::pow(1 + w * w * dt * dt, -5.0), phase = 10 * std::atan(w * dt);
  EXPECT_NEAR(ratio, decay * std::cos(phase), 1e-5);
}

TEST_P(ImplicitEuler, AMasslessCellGoesWithAUniformFluid) {
  Batch batch(testing::red_cell_model(), back_end, 1);
  batch.relax();
  const auto start = get(batch, Field::position);
  batch.write(Field::ambient_mass, 0, 1, testing::fluid_mass(batch.model()));
  batch.write(Field::ambient_velocity, 0, 1, uniform(batch.model(), 0.01, 0.02, -0.005));
  ASSERT_EQ(batch.step(1), 0);
  const auto x = get(batch, Field::position);
  const double dt = batch.options().time_step;
  for (std::size_t i = 0; i < x.size(); i += 3) {
    EXPECT_NEAR(x[i] - start[i], 0.01 * dt, 1e-8);
    EXPECT_NEAR(x[i + 2] - start[i + 2], -0.005 * dt, 1e-8);
  }
}

TEST_P(ImplicitEuler, TheFluidReceivesTheElasticForce) {
  // Without own mass, F = f_old + m_f (v - u)/dt equals -dE/dx + f_ext at the solution.
  Batch batch(testing::red_cell_model(), back_end, 1);
  batch.relax();
  batch.options().tolerance = 1e-9;
  batch.write(Field::ambient_mass, 0, 1, testing::fluid_mass(batch.model()));
  for (int s = 0; s < 5; ++s) {
    batch.write(Field::ambient_velocity, 0, 1, testing::shear(get(batch, Field::position), 1e-3));
    ASSERT_EQ(batch.step(1), 0);
  }
  batch.evaluate();
  const auto held = get(batch, Field::held_force), elastic = get(batch, Field::elastic_force);
  double largest = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    EXPECT_NEAR(held[i], elastic[i], 1e-6);
    largest = std::max(largest, std::abs(held[i]));
  }
  EXPECT_GT(largest, 0.01) << "a test on zero forces proves nothing";
}

TEST_P(ImplicitEuler, MomentumClosesWhateverTheTolerance) {
  // Sum of F = sum of f_ext - d(own momentum)/dt, to round-off, even where the solve is stopped early.
  Batch batch(testing::red_cell_model(2, 1), back_end, 1);
  batch.relax();
  batch.options().tolerance = 5;
  batch.options().residual_bound = 1e3;
  const auto& mass = batch.model().solid_mass;
  batch.write(Field::ambient_mass, 0, 1, testing::fluid_mass(batch.model()));
  testing::Random random(3);
  std::vector<double> load(get(batch, Field::position).size());
  for (double& f : load) f = random(-1, 1);
  batch.write(Field::external_force, 0, 1, load);
  for (int s = 0; s < 20; ++s) {
    const auto before = get(batch, Field::velocity);
    batch.write(Field::ambient_velocity, 0, 1, testing::shear(get(batch, Field::position), 5e-3));
    ASSERT_EQ(batch.step(1), 0);
    const auto after = get(batch, Field::velocity), held = get(batch, Field::held_force);
    std::vector<double> balance = held;
    double size = 0;
    for (std::size_t i = 0; i < balance.size(); ++i) {
      balance[i] += mass[i / 3] * (after[i] - before[i]) / batch.options().time_step - load[i];
      size += std::abs(held[i]);
    }
    for (const double rest : testing::total(balance)) EXPECT_LT(std::abs(rest), 1e-12 * size);
  }
}

TEST_P(ImplicitEuler, ResultTurnsWithTheCell) {
  const auto model = testing::red_cell_model();
  Batch batch(model, back_end, 2);
  batch.relax();
  batch.options().tolerance = 1e-9;
  const Vec3<double> axis{1, 2, -1}, shift{20, -3, 7};
  const double angle = 0.8;
  auto x = get(batch, Field::position), turned = x;
  auto u = testing::shear(x, 2e-3), turned_u = u;
  for (std::size_t i = 0; i < x.size(); i += 3) {
    const auto p = testing::moved({x[i], x[i + 1], x[i + 2]}, axis, angle, shift);
    const auto w = testing::moved({u[i], u[i + 1], u[i + 2]}, axis, angle, {0, 0, 0});
    turned[i] = p.x, turned[i + 1] = p.y, turned[i + 2] = p.z;
    turned_u[i] = w.x, turned_u[i + 1] = w.y, turned_u[i + 2] = w.z;
  }
  batch.write(Field::position, 1, 1, turned);
  for (int c = 0; c < 2; ++c) batch.write(Field::ambient_mass, c, 1, testing::fluid_mass(*model));
  batch.write(Field::ambient_velocity, 0, 1, u);
  batch.write(Field::ambient_velocity, 1, 1, turned_u);
  ASSERT_EQ(batch.step(10), 0);
  const auto a = get(batch, Field::position, 0), b = get(batch, Field::position, 1);
  for (std::size_t i = 0; i < a.size(); i += 3) {
    const auto p = testing::moved({a[i], a[i + 1], a[i + 2]}, axis, angle, shift);
    EXPECT_NEAR(b[i], p.x, 1e-8);
    EXPECT_NEAR(b[i + 1], p.y, 1e-8);
    EXPECT_NEAR(b[i + 2], p.z, 1e-8);
  }
}

TEST_P(ImplicitEuler, ACellsBitsDoNotDependOnItsNeighboursInTheBatch) {
  const auto model = testing::red_cell_model();
  const auto run = [&](int cells, int mine) {
    Batch batch(model, back_end, cells);
    batch.relax();
    for (int c = 0; c < cells; ++c) {
      batch.write(Field::ambient_mass, c, 1, testing::fluid_mass(*model));
      batch.write(Field::ambient_velocity, c, 1,
                  testing::shear(get(batch, Field::position, c), c == mine ? 1e-3 : 4e-3));
    }
    EXPECT_EQ(batch.step(5), 0);
    return batch.state_hash(mine);
  };
  EXPECT_EQ(run(1, 0), run(5, 3));
}

TEST_P(ImplicitEuler, AFailedCellKeepsItsStateAndTheOthersGoOn) {
  const auto model = testing::red_cell_model();
  Batch batch(model, back_end, 2);
  batch.relax();
  for (int c = 0; c < 2; ++c) batch.write(Field::ambient_mass, c, 1, testing::fluid_mass(*model));
  batch.write(Field::ambient_velocity, 0, 1, uniform(*model, 1e200, 0, 0));
  batch.write(Field::ambient_velocity, 1, 1, uniform(*model, 1e-2, 0, 0));
  const auto hash = batch.state_hash(0);
  const double before = batch.measure("centre_x", 1);
  EXPECT_EQ(batch.step(1), 1);
  EXPECT_TRUE(has_failed(batch.report(0).status));
  EXPECT_EQ(batch.state_hash(0), hash);
  EXPECT_EQ(batch.report(1).status, CellStatus::converged);
  EXPECT_GT(batch.measure("centre_x", 1), before);
  EXPECT_NE(batch.status_text(0).find("cell 0 failed"), std::string::npos);
}

TEST_P(ImplicitEuler, TheIterationCapIsAWarningOrAFailureByItsResidual) {
  const auto model = testing::red_cell_model();
  Batch batch(model, back_end, 1);
  batch.write(Field::ambient_mass, 0, 1, testing::fluid_mass(*model));
  batch.write(Field::ambient_velocity, 0, 1, testing::shear(get(batch, Field::position), 0.05));
  batch.options().time_step = 20;
  batch.options().max_iterations = 1;
  batch.options().newton_iterations = 0;
  batch.options().residual_bound = 1e6;
  EXPECT_EQ(batch.step(1), 0);
  EXPECT_EQ(batch.report(0).status, CellStatus::iteration_cap);
  batch.options().residual_bound = 0;
  EXPECT_EQ(batch.step(1), 1);
  EXPECT_EQ(batch.report(0).status, CellStatus::not_converged);
}

TEST_P(ImplicitEuler, NeedsAMass) {
  Batch batch(testing::red_cell_model(), back_end, 1);
  try {
    batch.step(1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::wrong_order);
    EXPECT_NE(std::string(e.what()).find("ambient_mass"), std::string::npos);
  }
}

}  // namespace
}  // namespace npfem
