// SPDX-License-Identifier: MPL-2.0
// A contact loads a vertex with f - k (x - x_n - dt v_n). Every vertex alike, a cell moves as one body and its step has
// a closed form.
#include <gtest/gtest.h>

#include <numeric>

#include "cells.h"

namespace npfem {
namespace {

using testing::get;
using testing::uniform;

constexpr double mass = 300, stiffness = 2000;  // fg, pN/um; M/dt^2 = 4800 pN/um

std::vector<double> of_every_vertex(const Batch& batch, double value) {
  return std::vector<double>(static_cast<std::size_t>(batch.model().num_vertices()), value);
}

/// Two red cells at rest in a fluid at rest.
struct CellsInFluid {
  explicit CellsInFluid(const char* back_end) : batch(testing::red_cell_model(2, 0), back_end, 2) {
    batch.relax();
    const auto n = static_cast<std::size_t>(batch.model().num_vertices());
    batch.write(Field::ambient_mass, 0, 2, std::vector<double>(2 * n, mass));
  }
  Batch batch;
};

/// By back end.
class ContactStiffness : public ::testing::TestWithParam<const char*> {
 protected:
  CellsInFluid cells{GetParam()};
  Batch& batch = cells.batch;
};
INSTANTIATE_TEST_SUITE_P(BackEnds, ContactStiffness, ::testing::Values("reference", "cpu"));

TEST_P(ContactStiffness, GivesWayToTheLoad) {
  const double dt = batch.options().time_step, load = 12;
  const auto start = get(batch, Field::position);
  batch.write(Field::velocity, 0, 1, uniform(batch.model(), 0.01, 0, 0));
  batch.write(Field::ambient_velocity, 0, 1, uniform(batch.model(), 0.01, 0, 0));
  batch.write(Field::external_force, 0, 1, uniform(batch.model(), 0, 0, load));
  batch.write(Field::contact_stiffness, 0, 1, of_every_vertex(batch, stiffness));
  ASSERT_EQ(batch.step(1), 0);
  const auto x = get(batch, Field::position), held = get(batch, Field::held_force);
  const double move = load / (mass / (dt * dt) + stiffness);
  for (std::size_t i = 0; i < start.size(); i += 3) {
    EXPECT_NEAR(x[i] - start[i], dt * 0.01, 1e-7) << "no drag on a contact that moves along";
    EXPECT_NEAR(x[i + 2] - start[i + 2], move, 1e-7);
  }
  double sum = 0;
  for (std::size_t i = 2; i < held.size(); i += 3) sum += held[i];
  const double all = batch.model().num_vertices() * (load - stiffness * move);
  EXPECT_NEAR(sum, all, 1e-10 * all) << "what the fluid receives";
}

TEST_P(ContactStiffness, HoldsWhereTheContactIsPredicted) {
  // The fluid at rest draws the cell back with M, its contact holds it at x_n + dt v_n with k.
  const double dt = batch.options().time_step, speed = 0.02;
  const auto start = get(batch, Field::position);
  batch.write(Field::velocity, 0, 1, uniform(batch.model(), 0, speed, 0));
  batch.write(Field::contact_stiffness, 0, 1, of_every_vertex(batch, stiffness));
  ASSERT_EQ(batch.step(1), 0);
  const auto x = get(batch, Field::position);
  const double share = stiffness / (mass / (dt * dt) + stiffness);
  for (std::size_t i = 1; i < start.size(); i += 3) EXPECT_NEAR(x[i] - start[i], share * dt * speed, 1e-7);
}

TEST_P(ContactStiffness, LeavesACellWithoutContactItsBits) {
  CellsInFluid others(GetParam());
  Batch& other = others.batch;
  for (Batch* b : {&batch, &other}) {
    b->write(Field::velocity, 1, 1, uniform(b->model(), 0.01, -0.02, 0));
    b->write(Field::external_force, 1, 1, uniform(b->model(), 0, 1, -3));
  }
  batch.write(Field::contact_stiffness, 0, 1, of_every_vertex(batch, stiffness));
  ASSERT_EQ(batch.step(3), 0);
  ASSERT_EQ(other.step(3), 0);
  EXPECT_EQ(batch.state_hash(1), other.state_hash(1));
}

TEST_P(ContactStiffness, IsPartOfAPackedCell) {
  batch.write(Field::contact_stiffness, 0, 1, of_every_vertex(batch, stiffness));
  std::vector<double> packed(static_cast<std::size_t>(batch.pack_length()));
  batch.pack(0, packed);
  batch.unpack(1, packed);
  auto k = of_every_vertex(batch, 0);
  batch.read(Field::contact_stiffness, 1, 1, k);
  EXPECT_EQ(k, of_every_vertex(batch, stiffness));
}

}  // namespace
}  // namespace npfem
