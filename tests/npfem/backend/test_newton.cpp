// SPDX-License-Identifier: MPL-2.0
#include "backend/newton.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "cells.h"
#include "model/hessian.h"
#include "random_shape.h"

namespace npfem {
namespace {

using testing::get;

/// One cell with everything an objective refers to: a pulled red cell with two patches.
struct Pulled {
  std::shared_ptr<const Model> model;
  VertexField start, drift, force;
  Eigen::VectorXd inertia;
  std::vector<Patch> patches{{{}, 50}, {{}, 50}};

  Pulled(double pull, double inertia_per_vertex) : model(testing::red_cell_model(2)) {
    const int n = model->num_vertices();
    start = Eigen::Map<const VertexField>(model->initial.front().data(), n, 3);
    drift = force = VertexField::Zero(n, 3);
    inertia = Eigen::VectorXd::Constant(n, inertia_per_vertex);
    for (int i = 0; i < n; ++i) {
      if (std::abs(start(i, 0)) > 3) patches[start(i, 0) > 0].vertices.push_back(i);
    }
    for (const int side : {0, 1}) {
      const auto& held = patches[static_cast<std::size_t>(side)].vertices;
      for (const int i : held) force(i, 0) = (side == 1 ? pull : -pull) / static_cast<double>(held.size());
    }
  }
  Dissipation none{*model};
  StepObjective objective() const { return {*model, start, inertia, drift, force, none, patches, start}; }
};

Eigen::MatrixXd second_derivative(const Pulled& pulled, const VertexField& displacement) {
  const VertexField x = pulled.start + displacement;
  const std::span<const double> positions(x.data(), static_cast<std::size_t>(x.size()));
  Eigen::MatrixXd h = elastic_hessian(*pulled.model, positions, Definite::exact);
  for (const GlobalStiffness& part : global_stiffness(*pulled.model, positions)) {
    h += part.stiffness * part.direction * part.direction.transpose();
  }
  for (Eigen::Index i = 0; i < h.rows(); ++i) h(i, i) += pulled.inertia(i / 3);
  for (const Patch& patch : pulled.patches) {
    for (const int i : patch.vertices) {
      for (int axis = 0; axis < 3; ++axis) {
        h(3 * i + axis, 3 * i + axis) += patch.stiffness;
        for (const int j : patch.vertices) {
          h(3 * i + axis, 3 * j + axis) -= patch.stiffness / static_cast<double>(patch.vertices.size());
        }
      }
    }
  }
  return h;
}

TEST(Newton, OneIterationIsTheDenseNewtonStep) {
  const Pulled pulled(5, 20);
  const StepObjective objective = pulled.objective();
  VertexField d = pulled.drift, gradient(d.rows(), 3), after(d.rows(), 3);
  double scale = 0;
  objective(d, gradient, scale);
  const Eigen::Map<const Eigen::VectorXd> g(gradient.data(), gradient.size());
  const Eigen::VectorXd expected = -second_derivative(pulled, d).llt().solve(g);
  EXPECT_EQ(newton_minimise(objective, {}, {1, 0}, d, after).iterations, 1);
  const Eigen::Map<const Eigen::VectorXd> moved(d.data(), d.size());
  EXPECT_LT((moved - expected).norm(), 1e-6 * expected.norm());
}

TEST(Newton, ConvergesQuadratically) {
  const Pulled pulled(20, 1);
  const StepObjective objective = pulled.objective();
  double residual[3];
  VertexField gradient(pulled.start.rows(), 3), near = pulled.drift;
  newton_minimise(objective, {}, {100, 0.05}, near, gradient);
  for (int iterations = 0; iterations < 3; ++iterations) {
    VertexField d = near;
    residual[iterations] = newton_minimise(objective, {}, {iterations, 0}, d, gradient).residual;
  }
  EXPECT_LT(residual[1], 1e-2 * residual[0]);
  EXPECT_LT(residual[2] / residual[1], 0.3 * residual[1] / residual[0])
      << "each iteration must gain more than the last";
}

TEST(Newton, EndsWhereTheQuasiNewtonIterationsEnd) {
  const Pulled pulled(40, 0.5);
  const StepObjective objective = pulled.objective();
  SolverOptions options;
  VertexField a = pulled.drift, b = pulled.drift, gradient(a.rows(), 3);
  const StepFactor factor(*pulled.model, pulled.inertia, {1, 0}, pulled.patches);
  const CellReport quasi = minimise(objective, factor, options, {5000, 1e-8}, a, gradient);
  const CellReport newton = newton_minimise(objective, options, {100, 1e-8}, b, gradient);
  ASSERT_EQ(quasi.status, CellStatus::converged);
  ASSERT_EQ(newton.status, CellStatus::converged);
  EXPECT_LT(newton.iterations, quasi.iterations / 4);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Newton, NeverGoesUphill) {
  Pulled pulled(0, 10);
  testing::Random random(4);
  for (Eigen::Index i = 0; i < pulled.drift.size(); ++i) pulled.drift.data()[i] = random(-3, 3);
  const StepObjective objective = pulled.objective();
  VertexField d = pulled.drift, gradient(d.rows(), 3);
  double scale = 0, before = objective(d, gradient, scale);
  for (int k = 0; k < 15; ++k) {
    newton_minimise(objective, {}, {1, 1e-9}, d, gradient);
    const double after = objective(d, gradient, scale);
    EXPECT_LE(after, before + 1e-12 * scale);
    before = after;
  }
}

TEST(Newton, FinishesAStepThatWouldHaveFailed) {
  const auto model = testing::red_cell_model();
  const auto step = [&](int newton_iterations) {
    Batch batch(model, "reference", 1);
    batch.write(Field::ambient_mass, 0, 1, testing::fluid_mass(*model));
    batch.write(Field::ambient_velocity, 0, 1, testing::shear(get(batch, Field::position), 0.05));
    batch.options().time_step = 20;
    batch.options().max_iterations = 2;
    batch.options().newton_iterations = newton_iterations;
    batch.step(1);
    return batch.report(0);
  };
  EXPECT_EQ(step(0).status, CellStatus::not_converged);
  EXPECT_EQ(step(100).status, CellStatus::converged);
  EXPECT_GT(step(100).iterations, 2);
}

}  // namespace
}  // namespace npfem
