// SPDX-License-Identifier: MPL-2.0
// What the back end "cpu" promises beyond agreement with the reference: its matrices, its rounding, its kernels.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>

#include "backend/cpu/threads.h"
#include "cpu_cells.h"
#include "error.h"

namespace npfem {
namespace {

using testing::cpu_settings;
using testing::CpuSetting;
using testing::get;

TEST(CpuBackend, RunsTheBestKernelsOfTheMachine) {
  const auto sets = cpu::instruction_sets();
  std::string names;
  for (const std::string& set : sets) names += set + " ";
  std::printf("instruction sets: %s\n", names.c_str());
  EXPECT_EQ(sets.back(), "baseline");
  // On an emulated machine the test is told what to find.
  if (const char* const expected = std::getenv("NPFEM_EXPECTED_INSTRUCTION_SETS")) {
    EXPECT_EQ(names, std::string(expected) + " ");
  }
  for (const std::string& set : sets) {
    ASSERT_NE(cpu::kernels(set), nullptr);
    EXPECT_EQ(cpu::kernels(set)->name, set);
  }
  EXPECT_EQ(cpu::kernels("sse9"), nullptr);
  const auto model = testing::cell_of("rbc");
  EXPECT_THROW(Batch(model, "cpu-sse9", 1), Error);
  const auto moved = [&](const std::string& back_end) {
    Batch batch(model, back_end, 1);
    testing::set_in_motion(batch, 0, 1);
    batch.options().tolerance = 1e-9;
    EXPECT_EQ(batch.step(2), 0);
    return get(batch, Field::position);
  };
  const auto best = moved("cpu");
  EXPECT_EQ(best, moved("cpu-" + sets.front()));
  EXPECT_LT(testing::largest_difference(best, moved("reference")), 1e-9);
}

/// Iterations of one step of 1 us of a red cell near its rest shape, with matrix 1 and with another, and those of the
/// latter that the rest-shape Hessian guided.
struct Iterations {
  int scalar, other, by_hessian;
};
Iterations iterations_near_rest(const CpuSetting& setting, int matrix, double turn) {
  const auto model = testing::cell_of("palabos-rbc");
  int count[2];
  CellReport report;
  for (const int trial : {0, 1}) {
    Batch batch(model, setting.back_end(), 1);
    setting.apply(batch.options());
    batch.options().time_step = 1;
    batch.options().matrix = trial == 0 ? 1 : matrix;
    auto x = get(batch, Field::position);
    for (std::size_t i = 0; i < x.size(); i += 3) {
      const auto p = testing::moved({x[i], x[i + 1], x[i + 2]}, {1, 2, -1}, turn, {5, 5, 5});
      x[i] = p.x, x[i + 1] = p.y, x[i + 2] = p.z;
    }
    batch.write(Field::position, 0, 1, x);
    testing::set_in_motion(batch, 0, 3, 0.001);
    EXPECT_EQ(batch.step(1), 0);
    report = batch.report(0);
    EXPECT_EQ(report.status, CellStatus::converged) << batch.status_text(0);
    count[trial] = report.iterations;
    if (trial == 0) {
      EXPECT_EQ(report.hessian_iterations, 0);
    }
  }
  return {count[0], count[1], report.hessian_iterations};
}

TEST(CpuBackend, TheRestShapeHessianIsTheBetterGuideNearRest) {
  for (const CpuSetting& setting : cpu_settings()) {
    if (setting.precision == 2) continue;  // float stops where its rounding does
    for (const int matrix : {0, 2}) {
      for (const double turn : {0.0, 2.0}) {
        const Iterations found = iterations_near_rest(setting, matrix, turn);
        std::printf("%s, matrix %d: %d iterations for %d\n", setting.name().c_str(), matrix, found.other, found.scalar);
        EXPECT_GT(found.by_hessian, 0) << setting.name();
        EXPECT_LE(found.other, 4) << setting.name() << ", matrix " << matrix << ", turned by " << turn;
        EXPECT_GE(found.scalar, 15) << setting.name();
      }
    }
  }
}

TEST(CpuBackend, TheRestShapeHessianIsLeftFarFromRest) {
  Batch batch(testing::cell_of("rbc"), "cpu", 1);
  auto x = get(batch, Field::position);
  for (std::size_t i = 0; i < x.size(); i += 3) x[i] *= 2, x[i + 1] *= 0.6;
  batch.write(Field::position, 0, 1, x);
  batch.step(1);
  EXPECT_GT(batch.report(0).iterations, 0);
  EXPECT_EQ(batch.report(0).hessian_iterations, 0);
}

TEST(CpuBackend, StepsOfOtherLengthsBeforeLeaveNoTrace) {
  // A step by BDF2 needs the matrices of cells with and without a past at once, whatever others there were before.
  const auto model = testing::cell_of("rbc");
  Batch used(model, "cpu", 1), fresh(model, "cpu", 1);
  testing::set_in_motion(used, 0, 3, 0.002);
  for (const double dt : {0.4, 0.3, 0.2, 0.1}) {
    used.options().time_step = dt;
    EXPECT_EQ(used.step(1), 0);
  }
  std::vector<double> packed(static_cast<std::size_t>(used.pack_length()));
  used.pack(0, packed);
  fresh.unpack(0, packed);
  for (Batch* batch : {&used, &fresh}) {
    batch->options().time_step = 0.4;
    batch->options().integrator = Integrator::bdf2;
    EXPECT_EQ(batch->step(3), 0);
  }
  EXPECT_EQ(used.state_hash(0), fresh.state_hash(0));
}

TEST(CpuBackend, EveryCellMayHaveItsOwnMasses) {
  // More masses than a step handles at once; every cell must still make its own step, once.
  const auto model = testing::cell_of("rbc");
  constexpr int cells = 19;
  const auto prepare = [](Batch& batch, int cell, int kind) {
    testing::set_in_motion(batch, cell, 3);
    testing::immerse(batch, cell, 5e-3, 1 + kind);
  };
  Batch together(model, "cpu", cells);
  for (int c = 0; c < cells; ++c) prepare(together, c, c);
  EXPECT_EQ(together.step(3), 0);
  for (int c = 0; c < cells; ++c) {
    Batch alone(model, "cpu", 1);
    prepare(alone, 0, c);
    EXPECT_EQ(alone.step(3), 0);
    EXPECT_EQ(alone.state_hash(0), together.state_hash(c)) << "cell " << c;
  }
}

TEST(CpuBackend, WhatAThreadThrowsReachesTheCaller) {
  for (const int threads : {1, 4}) {
    std::atomic<int> done{0};
    EXPECT_THROW(cpu::for_each_piece(8, threads,
                                     [&](int piece, int) {
                                       if (piece == 3) throw std::runtime_error("piece 3");
                                       ++done;
                                     }),
                 std::runtime_error);
    EXPECT_LE(done, 7);
  }
}

TEST(CpuBackend, MomentumClosesWhateverTheTolerance) {
  // Sum of F = sum of f_ext - d(own momentum)/dt, even where the solve is stopped early: to the rounding of forces.
  const double bound[] = {1e-12, 1e-12, 1e-6};
  for (const CpuSetting& setting : cpu_settings()) {
    Batch batch(testing::cell_of("rbc"), setting.back_end(), 2);
    setting.apply(batch.options());
    batch.options().tolerance = 5;
    batch.options().residual_bound = 1e3;
    const auto& mass = batch.model().solid_mass;
    for (int c = 0; c < 2; ++c) {
      testing::load(batch, c, 3, 1);
      testing::immerse(batch, c, 5e-3);
    }
    const auto load = get(batch, Field::external_force, 1);
    for (int s = 0; s < 5; ++s) {
      const auto before = get(batch, Field::velocity, 1);
      ASSERT_EQ(batch.step(1), 0);
      const auto after = get(batch, Field::velocity, 1), held = get(batch, Field::held_force, 1);
      std::vector<double> balance = held;
      double size = 0;
      for (std::size_t i = 0; i < balance.size(); ++i) {
        balance[i] += mass[i / 3] * (after[i] - before[i]) / batch.options().time_step - load[i];
        size += std::abs(held[i]);
      }
      for (const double rest : testing::total(balance))
        EXPECT_LT(std::abs(rest), bound[setting.precision] * size) << setting.name();
    }
  }
}

}  // namespace
}  // namespace npfem
