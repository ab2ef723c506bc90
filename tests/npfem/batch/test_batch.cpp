// SPDX-License-Identifier: MPL-2.0
#include "batch/batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cells.h"
#include "error.h"

namespace npfem {
namespace {

using testing::get;

TEST(Batch, PackedCellsMoveBetweenBatchesBitForBit) {
  const auto model = testing::red_cell_model(2, 1);
  Batch from(model, "reference", 3), to(model, "reference", 0);
  from.relax();
  from.write(Field::velocity, 1, 1, testing::uniform(*model, 0.1, 0.2, 0.3));
  from.step(3);
  std::vector<double> packed(static_cast<std::size_t>(from.pack_length()));
  from.pack(1, packed);
  const int cell = to.add_cells(1);
  to.unpack(cell, packed);
  EXPECT_EQ(to.state_hash(cell), from.state_hash(1));
  from.step(4);
  to.step(4);
  EXPECT_EQ(to.state_hash(cell), from.state_hash(1));
}

TEST(Batch, RemovingACellKeepsTheOthers) {
  Batch batch(testing::red_cell_model(2, 1), "reference", 3);
  for (int c = 0; c < 3; ++c) batch.write(Field::velocity, c, 1, testing::uniform(batch.model(), c, 0, 0));
  const auto last = batch.state_hash(2);
  batch.remove_cell(1);
  EXPECT_EQ(batch.num_cells(), 2);
  EXPECT_EQ(batch.state_hash(1), last);
}

TEST(Batch, RefusesNumbersThatAreNotFiniteAndChangesNothing) {
  Batch batch(testing::red_cell_model(), "reference", 2);
  const auto hash = batch.state_hash(1);
  auto x = get(batch, Field::position, 1);
  x[7] = std::numeric_limits<double>::quiet_NaN();
  try {
    batch.write(Field::position, 1, 1, x);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::bad_input);
    EXPECT_NE(std::string(e.what()).find("vertex 2 of cell 1"), std::string::npos) << e.what();
  }
  EXPECT_EQ(batch.state_hash(1), hash);
}

TEST(Batch, ChecksRangesAndLengths) {
  Batch batch(testing::red_cell_model(), "reference", 2);
  std::vector<double> values(10);
  EXPECT_THROW(batch.read(Field::position, 0, 1, values), Error);
  EXPECT_THROW(batch.read(Field::position, 2, 1, values), Error);
  EXPECT_THROW(batch.read(Field::position, std::numeric_limits<int>::max(), 2, values), Error);
  EXPECT_THROW(batch.write(Field::elastic_force, 0, 1, values), Error);
  EXPECT_THROW(batch.add_patch(std::vector<int>{1, 1}, 5), Error);
  EXPECT_THROW(batch.add_patch(std::vector<int>{1, 100000}, 5), Error);
  EXPECT_THROW(batch.measure("volum", 0), Error);
  EXPECT_THROW(field_by_name("positon"), Error);
}

TEST(Batch, UnknownBackEndListsThoseThereAre) {
  try {
    Batch batch(testing::red_cell_model(), "cuda", 1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::unavailable);
    EXPECT_NE(std::string(e.what()).find("reference"), std::string::npos);
  }
}

TEST(Batch, EnergiesByNameAddUp) {
  Batch batch(testing::red_cell_model(), "reference", 1);
  batch.evaluate();
  double sum = 0;
  for (const auto& name : batch.model().energy_names()) sum += batch.measure("energy:" + name, 0);
  EXPECT_DOUBLE_EQ(batch.measure("energy", 0), sum);
  EXPECT_GT(sum, 0);
  batch.relax();
  EXPECT_THROW(batch.measure("energy", 0), Error) << "energies of another shape must not be handed out";
}

TEST(Batch, HashSeesOneBit) {
  Batch batch(testing::red_cell_model(), "reference", 1);
  const auto hash = batch.state_hash(0);
  auto x = get(batch, Field::position);
  x[10] = std::nextafter(x[10], 100.0);
  batch.write(Field::position, 0, 1, x);
  EXPECT_NE(batch.state_hash(0), hash);
}

}  // namespace
}  // namespace npfem
