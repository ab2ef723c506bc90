// SPDX-License-Identifier: MPL-2.0
// The order of the integrators, with and without membrane viscosity, and what BDF2 remembers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cells.h"
#include "error.h"
#include "random_shape.h"
#include "released_cell.h"

namespace npfem {
namespace {

using testing::get;
using testing::red_cell;
using testing::total;
using testing::uniform;

/// By back end.
class TimeIntegration : public ::testing::TestWithParam<const char*> {
 protected:
  const char* back_end = GetParam();
};
INSTANTIATE_TEST_SUITE_P(BackEnds, TimeIntegration, ::testing::Values("reference", "cpu"));

const int both[] = {Integrator::implicit_euler, Integrator::bdf2};
const double order_margin[] = {0.15, 0.2};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Prints the errors of runs whose step is halved each time, and expects the order from one to the next.
void expect_order(const char* what, int integrator, const std::vector<double>& errors) {
  std::printf("%s, integrator %d: error %.3g", what, integrator, errors.front());
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const double order = std::log2(errors[i - 1] / errors[i]);
    std::printf(", %.3g (order %.2f)", errors[i], order);
    EXPECT_NEAR(order, 1.0 + integrator, order_margin[integrator]) << what;
  }
  std::printf("\n");
}

/// An icosahedron that breathes: one mode m s" + c s' + k s = 0 of its relative size 1 + s, k by its volume modulus
/// and c by the dilatational viscosity of its membrane.
struct Breathing {
  const char* back_end;
  std::shared_ptr<const Model> model;
  double mass, damping, stiffness;
  std::vector<double> rest;

  Breathing(const char* back_end_name, double viscosity) : back_end(back_end_name) {
    Material material;
    material.set("global_volume_modulus", 1000);
    material.set("membrane_density", 3);
    material.set("membrane_dilatational_viscosity", viscosity);
    model = std::make_shared<const Model>(build_model(icosahedral_sphere(0), material));
    for (const Point& p : model->initial) rest.insert(rest.end(), p.begin(), p.end());
    mass = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) mass += model->solid_mass[i / 3] * rest[i] * rest[i];
    damping = 4 * viscosity * model->rest.area;
    stiffness = 9 * 1000 * model->rest.volume;
  }

  /// s/s_0 after `steps` from a start at s_0 without velocity. Half the difference of starts at +s_0 and -s_0, which
  /// leaves of the cell's nonlinearity s_0^2 only.
  double after(int steps, double dt, int integrator) const {
    const double amplitude = 3e-4;
    return (end_of(amplitude, steps, dt, integrator) - end_of(-amplitude, steps, dt, integrator)) / (2 * amplitude);
  }

  double end_of(double amplitude, int steps, double dt, int integrator) const {
    Batch batch(model, back_end, 1);
    batch.options().tolerance = 0;  // as far as rounding lets it go
    batch.options().integrator = integrator;
    batch.options().time_step = dt;
    auto x = rest;
    for (double& c : x) c *= 1 + amplitude;
    batch.write(Field::position, 0, 1, x);
    EXPECT_EQ(batch.step(steps), 0);
    const auto moved = get(batch, Field::position);
    double along = 0, square = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) along += moved[i] * rest[i], square += rest[i] * rest[i];
    return along / square - 1;
  }
};

TEST_P(TimeIntegration, OrderOnAHarmonicMode) {
  const Breathing sphere(back_end, 0);
  const double w = std::sqrt(sphere.stiffness / sphere.mass), end = 2.0 / w;
  for (const int integrator : both) {
    std::vector<double> errors;
    for (const int steps : {12, 24, 48, 96}) {
      errors.push_back(std::abs(sphere.after(steps, end / steps, integrator) - std::cos(w * end)));
    }
    expect_order("harmonic mode", integrator, errors);
  }
}

TEST_P(TimeIntegration, OrderOnAViscousMode) {
  // Damped to twice the critical value: s = (r1 e^(r2 t) - r2 e^(r1 t))/(r1 - r2).
  const Breathing bare(back_end, 0);
  const double viscosity = 4 * std::sqrt(bare.mass * bare.stiffness) / (4 * bare.model->rest.area);
  const Breathing sphere(back_end, viscosity);
  const double p = sphere.damping / (2 * sphere.mass), root = std::sqrt(p * p - sphere.stiffness / sphere.mass);
  const double r1 = -p + root, r2 = -p - root, end = 1.5 / -r1;
  const double exact = (r1 * std::exp(r2 * end) - r2 * std::exp(r1 * end)) / (r1 - r2);
  for (const int integrator : both) {
    std::vector<double> errors;
    for (const int steps : {12, 24, 48, 96}) {
      errors.push_back(std::abs(sphere.after(steps, end / steps, integrator) - exact));
    }
    expect_order("viscous mode", integrator, errors);
  }
}

void expect_orders_of_release(const char* back_end, const char* what, double viscosity) {
  Material material = Material::preset("rbc");
  material.set("membrane_density", 1000);
  material.set("membrane_shear_viscosity", viscosity);
  material.set("membrane_dilatational_viscosity", 2 * viscosity);
  Batch batch(red_cell(material), back_end, 1);
  testing::stretch_and_release(batch, 30);
  std::vector<double> start(static_cast<std::size_t>(batch.pack_length()));
  batch.pack(0, start);
  batch.options().tolerance = 1e-9;
  batch.options().max_iterations = 2000;
  const auto run = [&](int steps, int integrator) {
    batch.unpack(0, start);
    batch.options().integrator = integrator;
    batch.options().time_step = 8.0 / steps;
    EXPECT_EQ(batch.step(steps), 0);
    return get(batch, Field::position);
  };
  const auto converged = run(16 * 800, Integrator::bdf2);
  for (const int integrator : both) {
    std::vector<double> errors;
    for (const int steps : {100, 200, 400, 800})
      errors.push_back(largest_difference(run(steps, integrator), converged));
    expect_order(what, integrator, errors);
  }
}

TEST_P(TimeIntegration, OrderOnAReleasedRedCell) {
  expect_orders_of_release(back_end, "released red cell", 0);
}

TEST_P(TimeIntegration, OrderOnAReleasedViscousRedCell) {
  expect_orders_of_release(back_end, "released viscous red cell", 50);
}

TEST_P(TimeIntegration, MembraneViscosityIsThatOfTheClosedFormAtAnyStep) {
  // Without inertia s = s_0 exp(-t k/c). The breathing mode with a mass too small to matter and a viscosity in charge.
  const Breathing bare(back_end, 0);
  const Breathing sphere(back_end, 100 * std::sqrt(bare.mass * bare.stiffness) / (4 * bare.model->rest.area));
  const double tau = sphere.damping / sphere.stiffness;
  for (const int steps : {40, 160}) {
    EXPECT_NEAR(sphere.after(steps, tau / steps, Integrator::bdf2), std::exp(-1.0), 5e-4);
    EXPECT_NEAR(sphere.after(steps, tau / steps, Integrator::implicit_euler), std::pow(1 + 1.0 / steps, -steps), 5e-4);
  }
}

TEST_P(TimeIntegration, Bdf2MovesUniformlyWithoutForces) {
  Material material = Material::preset("rbc");
  material.set("membrane_density", 5);
  material.set("stress_free_reduced_volume", 0);
  material.set("membrane_shear_viscosity", 1e6);
  Batch batch(red_cell(material), back_end, 1);
  batch.options().integrator = Integrator::bdf2;
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

/// A cell with mass under loads that do not balance, solved loosely.
struct LoadedCell {
  Batch batch;
  std::vector<double> load;

  explicit LoadedCell(const char* back_end) : batch(testing::red_cell_model(2, 1), back_end, 1) {
    batch.relax();
    batch.options().integrator = Integrator::bdf2;
    batch.options().tolerance = 5;
    batch.options().residual_bound = 1e3;
    testing::Random random(3);
    load = get(batch, Field::position);
    for (double& f : load) f = random(-1, 1.5);
    batch.write(Field::external_force, 0, 1, load);
  }
  std::vector<double> momentum() const {
    auto p = get(batch, Field::velocity);
    for (std::size_t i = 0; i < p.size(); ++i) p[i] *= batch.model().solid_mass[i / 3];
    return total(p);
  }
};

TEST_P(TimeIntegration, Bdf2KeepsMomentumWhateverTheTolerance) {
  // The start by implicit Euler gives P_1 = dt F, and BDF2's (3 P_{n+1} - 4 P_n + P_{n-1})/(2 dt) = F keeps P = t F.
  LoadedCell cell(back_end);
  const auto force = total(cell.load);
  for (int s = 1; s <= 20; ++s) {
    ASSERT_EQ(cell.batch.step(1), 0);
    const auto momentum = cell.momentum();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double impulse = s * cell.batch.options().time_step * force[axis];
      EXPECT_NEAR(momentum[axis], impulse, 1e-12 * std::abs(impulse));
    }
  }
}

TEST_P(TimeIntegration, TheLagFieldsAreThePastOfTheCell) {
  LoadedCell cell(back_end);
  Batch& batch = cell.batch;
  const double dt = batch.options().time_step;
  const auto x0 = get(batch, Field::position);
  batch.step(1);
  const auto x1 = get(batch, Field::position), v1 = get(batch, Field::velocity);
  batch.step(1);
  const auto x2 = get(batch, Field::position), v2 = get(batch, Field::velocity);
  const auto w = get(batch, Field::lag_velocity), a = get(batch, Field::lag_acceleration);
  double largest = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    EXPECT_NEAR(w[i], (x2[i] - x1[i]) / dt - v2[i], 1e-12);
    EXPECT_NEAR(a[i], (v2[i] - v1[i]) / dt, 1e-12);
    EXPECT_NEAR(v2[i], (3 * x2[i] - 4 * x1[i] + x0[i]) / (2 * dt), 1e-12);
    largest = std::max(largest, std::abs(w[i]));
  }
  EXPECT_GT(largest, 1e-4) << "a test on zeros proves nothing";
  // A new velocity is a new motion, and so is what implicit Euler leaves behind.
  batch.write(Field::velocity, 0, 1, v2);
  EXPECT_EQ(get(batch, Field::lag_velocity), uniform(batch.model(), 0, 0, 0));
  EXPECT_EQ(get(batch, Field::lag_acceleration), uniform(batch.model(), 0, 0, 0));
  batch.step(2);
  EXPECT_NE(get(batch, Field::lag_acceleration), uniform(batch.model(), 0, 0, 0));
  batch.options().integrator = Integrator::implicit_euler;
  batch.step(1);
  EXPECT_EQ(get(batch, Field::lag_acceleration), uniform(batch.model(), 0, 0, 0));
}

TEST_P(TimeIntegration, APackedCellTakesItsPastAlong) {
  LoadedCell cell(back_end);
  Batch& batch = cell.batch;
  batch.step(3);
  std::vector<double> packed(static_cast<std::size_t>(batch.pack_length()));
  batch.pack(0, packed);
  const auto hash = batch.state_hash(0);
  batch.step(3);
  const auto later = batch.state_hash(0);
  batch.unpack(0, packed);
  EXPECT_EQ(batch.state_hash(0), hash);
  batch.step(3);
  EXPECT_EQ(batch.state_hash(0), later);
  batch.unpack(0, packed);
  batch.write(Field::lag_velocity, 0, 1, uniform(batch.model(), 0, 0, 0));
  EXPECT_NE(batch.state_hash(0), hash);
}

void expect_refused(Batch& batch, const char* part) {
  const auto hash = batch.state_hash(0);
  try {
    batch.step(1);
    FAIL() << part;
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::wrong_order);
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
  EXPECT_EQ(batch.state_hash(0), hash);
}

TEST_P(TimeIntegration, Bdf2IsRefusedInAFluidAndForTheLineage) {
  Batch batch(testing::red_cell_model(2, 1), back_end, 2);
  batch.options().integrator = Integrator::bdf2;
  batch.write(Field::ambient_mass, 1, 1, testing::fluid_mass(batch.model()));
  expect_refused(batch, "cell 1 has the ambient_mass");
  batch.write(Field::ambient_mass, 1, 1, std::vector<double>(testing::fluid_mass(batch.model()).size(), 0.0));
  batch.write(Field::held_force, 0, 1, uniform(batch.model(), 0, 0, -1));
  expect_refused(batch, "cell 0 has the held_force -1; set integrator = 0");
  batch.write(Field::held_force, 0, 1, uniform(batch.model(), 0, 0, 0));
  EXPECT_EQ(batch.step(1), 0);
  batch.options().lineage = true;
  expect_refused(batch, "lineage");
}

}  // namespace
}  // namespace npfem
