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

TEST(Batch, RefusesOptionsOutOfRangeBeforeAnyStep) {
  Batch batch(testing::red_cell_model(2, 1), "reference", 1);
  const auto hash = batch.state_hash(0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double dt : {0.0, -0.25, nan, infinity, 1e-10, 1e13}) {
    batch.options().time_step = dt;
    int steps = 0;
    EXPECT_THROW(batch.step_for_ms(1, steps), Error);
    EXPECT_THROW(batch.relax(), Error);
    try {
      batch.step(1);
      FAIL() << dt;
    } catch (const Error& e) {
      EXPECT_EQ(e.status(), Status::bad_input);
      EXPECT_NE(std::string(e.what()).find("\"time_step\""), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("allowed are numbers from"), std::string::npos) << e.what();
    }
  }
  EXPECT_EQ(batch.state_hash(0), hash);
}

TEST(Batch, StepsAtBothEndsOfTheAllowedTimeStepsOrSaysWhyNot) {
  for (const char* back_end : {"reference", "cpu"}) {
    for (const double dt : {1e-9, 1e12}) {
      Batch batch(testing::red_cell_model(2, 1), back_end, 1);
      batch.relax();
      batch.options().time_step = dt;
      try {
        EXPECT_EQ(batch.step(1), 0) << back_end << ", " << dt;
        EXPECT_NEAR(batch.measure("volume", 0), batch.model().rest.volume, 1e-3 * batch.model().rest.volume);
      } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("time_step"), std::string::npos) << e.what();
      }
    }
  }
}

TEST(Batch, RefusesMassesThatPhysicsDoesNotAllow) {
  Batch batch(testing::red_cell_model(2, 1), "reference", 1);
  const auto hash = batch.state_hash(0);
  std::vector<double> packed(static_cast<std::size_t>(batch.pack_length()));
  batch.pack(0, packed);
  const auto vertices = static_cast<std::size_t>(batch.model().num_vertices());
  for (const double bad : {-1e-3, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<double> mass(vertices, 1.0);
    mass[4] = bad;
    auto damaged = packed;
    damaged[13 * vertices + 4] = bad;  // position, velocity, external force, contact stiffness, ambient velocity before
    for (const bool whole_cell : {false, true}) {
      try {
        whole_cell ? batch.unpack(0, damaged) : batch.write(Field::ambient_mass, 0, 1, mass);
        FAIL() << bad;
      } catch (const Error& e) {
        EXPECT_EQ(e.status(), Status::bad_input);
        EXPECT_NE(std::string(e.what()).find("field \"ambient_mass\""), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("vertex 4 of cell 0"), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("at least 0"), std::string::npos) << e.what();
      }
    }
  }
  EXPECT_EQ(batch.state_hash(0), hash);
}

TEST(Batch, RelaxNeedsAMaterialThatHoldsTheShape) {
  Material material;
  material.set("global_volume_modulus", 1000);
  Batch batch(std::make_shared<const Model>(build_model(icosahedral_sphere(1), material)), "reference", 1);
  try {
    batch.relax();
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::bad_input);
    EXPECT_NE(std::string(e.what()).find("membrane or bending law of positive modulus"), std::string::npos) << e.what();
  }
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
