// SPDX-License-Identifier: MPL-2.0
#include "batch/operation_count.h"

#include <gtest/gtest.h>

#include "cells.h"

namespace npfem {
namespace {

/// One triangle of one membrane law; other parts empty.
Model one_triangle() {
  Model model;
  model.initial = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.triangles = {{0, 1, 2}};
  const Vec3<double> x[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  auto& block = model.block<Membrane<Skalak>>();
  block.vertices = {{0, 1, 2}};
  block.params = {{2.0, 10.0}};
  block.rest = {triangle_rest(x)};
  model.weight.resize(3, 3);
  model.weight.setIdentity();
  return model;
}

// By hand. Strain 46: edges 6, their cross product 9, its norm 6, the unit normal 4, t 20 (three dot products 15, three
// factors, two additions), J 1. Skalak's law 17: I1 1, I2 2, W 8, dW/dt 2, dW/dJ 4. Gradient 59: two factors, 27 for
// each of two corners (metric 9, its factor 3, cross product 9, its factor 3, sum 3), 3 for the last.
constexpr long strain = 46, law = 17, gradient = 59;

TEST(OperationCount, SkalakTriangleCountedByHand) {
  EXPECT_EQ(count_element<Membrane<Skalak>>(one_triangle()), strain + law + gradient + 1);
}

TEST(OperationCount, ConstantsAndChoicesAreNoOperations) {
  long counter = 0;
  const Counted a{3, counter}, constant = 2.0;
  const Counted b = select(a < constant, a, constant);
  EXPECT_EQ(counter, 0);
  EXPECT_EQ(-a > b, false);
  static_cast<void>(constant * constant);
  EXPECT_EQ(counter, 0);
  static_cast<void>(square_root(a * b / (a - constant) + b));
  EXPECT_EQ(counter, 5);
  static_cast<void>(clamp(b, constant, constant) * constant);  // a chosen constant still stands for a number of a cell
  EXPECT_EQ(counter, 6);
}

TEST(OperationCount, LawsOnOneTriangleShareItsStrain) {
  Model model = one_triangle();
  const double one = count_operations(model).elastic;
  EXPECT_EQ(one, strain + gradient + 9 + law + 4);
  auto& second = model.block<Membrane<LineageSurfaceMaterial>>();
  second.vertices = {{0, 1, 2}};
  second.params = {{35.0, 5.0, 27.5}};
  second.rest = model.block<Membrane<Skalak>>().rest;
  const long second_law = count_element<Membrane<LineageSurfaceMaterial>>(model) - strain - gradient - 1;
  EXPECT_EQ(count_operations(model).elastic, one + static_cast<double>(second_law + 4));
  second.rest[0].area *= 2;  // another rest shape: a strain of its own
  EXPECT_EQ(count_operations(model).elastic, one + static_cast<double>(strain + gradient + 9 + second_law + 4));
}

TEST(OperationCount, ModelIsTheSumOfItsElements) {
  for (const int level : {2, 3}) {
    Material material = Material::preset("rbc");
    material.set("global_area_modulus", 0);
    material.set("global_volume_modulus", 0);
    material.set("collapse_modulus", 0);
    const Model model = build_model(evans_fung_cell(level), material);
    const double triangles = static_cast<double>(model.triangles.size());
    const double hinges = static_cast<double>(model.block<DihedralBending>().size());
    // The surface and the stress-free shape of this material differ, and only the latter bears a law.
    const double bending = static_cast<double>(count_element<DihedralBending>(model) + 1 + 12);
    EXPECT_EQ(count_operations(model).elastic, triangles * (strain + gradient + 9 + law + 4) + hinges * bending);
  }
}

TEST(OperationCount, SolvesCountTheNonzerosOfTheFactor) {
  Model model = one_triangle();
  EXPECT_EQ(count_operations(model).scalar_solve, 9);  // a diagonal: one factor for each coordinate
  model.weight = Eigen::MatrixXd::Ones(3, 3).sparseView();
  EXPECT_EQ(count_operations(model).scalar_solve, 9 + 2 * 6 * 3);
  EXPECT_EQ(count_operations(model).block_solve, 3 * 3 * 15 + 2 * 18 * 3);
}

TEST(OperationCount, StepIsTheSumOfWhatItReports) {
  const OperationCount count{300, 1000, 10, 500, 2000, 40};
  SolverOptions options;
  options.history = 2;
  CellReport report;
  report.evaluations = 1;
  EXPECT_EQ(operations_of_step(count, options, report), 1000 + 10 + 3000);
  report.evaluations = 5, report.iterations = 4, report.hessian_iterations = 1;
  const double pairs = 0 + 1 + 2 + 2;
  EXPECT_EQ(operations_of_step(count, options, report),
            5 * (1000 + 10 + 3000) + 3 * 500 + 2000 + 300 * (8 * pairs + 8 * 4) + 2 * 4 * 300);
}

TEST(Batch, TellsTheOperationsOfItsLastStep) {
  for (const char* method : {"reference", "cpu"}) {
    for (const bool lineage : {false, true}) {
      Batch batch(testing::red_cell_model(2, 400), method, 2);
      batch.options().lineage = lineage;
      batch.write(Field::velocity, 1, 1, testing::shear(testing::get(batch, Field::position), 1e-3));
      batch.step(1);
      const double evaluations = batch.measure("evaluations", 1);
      EXPECT_GE(evaluations, 2) << method;
      EXPECT_EQ(batch.measure("hessian_iterations", 1), batch.report(1).hessian_iterations);
      EXPECT_EQ(batch.measure("flops", 1),
                operations_of_step(count_operations(batch.model()), batch.options(), batch.report(1)));
      EXPECT_GT(batch.measure("flops", 1), evaluations * count_operations(batch.model()).elastic);
    }
  }
}

}  // namespace
}  // namespace npfem
