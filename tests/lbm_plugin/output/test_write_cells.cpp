// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell_shapes.h"
#include "folder_of_rank_zero.h"
#include "mpi_environment.h"
#include "output/write_cells.h"
#include "scratch_folder.h"
#include "vtk_reader.h"

namespace npfem::flow {
namespace {

constexpr int cells = 7;

Setup two_types() {
  Setup setup;
  setup.domain = {DomainKind::periodic_box, {20, 20, 20}, 0.5, 0, 0};
  setup.types = {testing::sphere(1.0, 1), testing::platelet(2)};
  for (int id = 0; id < cells; ++id) setup.cells.push_back({id % 3 == 1 ? 1 : 0, {}, identity_rotation});
  return setup;
}

/// Cell number id, displaced by 10.25 id along x: two boxes and more away for the later ones.
CellState cell_of(const Setup& setup, int id) {
  CellState cell{};
  cell.id = id;
  cell.type = setup.cells[static_cast<std::size_t>(id)].type;
  cell.position = setup.types[static_cast<std::size_t>(cell.type)].shape;
  for (std::size_t n = 0; n < cell.position.size(); ++n) {
    cell.position[n] += n % 3 == 0 ? 10.25 * id : 1.5;
    cell.velocity.push_back(id + 0.001 * static_cast<double>(n));
    cell.force.push_back(-static_cast<double>(n));
  }
  return cell;
}

std::string written(const std::filesystem::path& path, bool into_box, const std::vector<int>& left = {}) {
  const flow::Setup setup = two_types();
  std::vector<Departure> departures;
  for (const int id : left) departures.push_back({id, setup.cells[static_cast<std::size_t>(id)].type, 0, {}, {}, 0});
  std::vector<CellState> local;
  for (int id = 0; id < cells; ++id) {
    if (std::find(left.begin(), left.end(), id) != left.end()) continue;
    if (id * world().size() / cells == world().rank()) local.push_back(cell_of(setup, id));
  }
  write_cells(world(), path, 12.5, cell_arrays(setup, departures, local, into_box));
  world().barrier();
  return content_of(path);
}

TEST(WriteCells, ReadsBackWholeAndInOrder) {
  const ScratchFolder own("write_cells");
  const std::string file = written(folder_of_rank_zero(own) / "cells.vtu", false);
  const flow::Setup setup = two_types();
  const auto points = array_of<double>(file, "points_um");
  const auto velocity = array_of<float>(file, "velocity_um_per_us");
  const auto force = array_of<float>(file, "force_pN");
  const auto connectivity = array_of<std::int32_t>(file, "connectivity");
  const auto offsets = array_of<std::int32_t>(file, "offsets");
  const auto types = array_of<std::uint8_t>(file, "types");
  const auto ids = array_of<std::int32_t>(file, "cell_id");
  const auto kinds = array_of<std::int32_t>(file, "cell_type");
  const auto larger = array_of<float>(file, "larger_stretch");
  const auto smaller = array_of<float>(file, "smaller_stretch");
  EXPECT_EQ(attribute(file, "NumberOfPoints", "NumberOfPoints"), std::to_string(points.size() / 3));
  EXPECT_EQ(attribute(file, "NumberOfCells", "NumberOfCells"), std::to_string(offsets.size()));
  EXPECT_NE(file.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">12.5<"), std::string::npos);

  std::size_t vertex = 0, triangle = 0;
  for (int id = 0; id < cells; ++id) {
    const CellState cell = cell_of(setup, id);
    const auto& corners = setup.types[static_cast<std::size_t>(cell.type)].triangles;
    for (std::size_t n = 0; n < cell.position.size(); ++n) {
      ASSERT_EQ(points[3 * vertex + n], cell.position[n]);
      ASSERT_EQ(velocity[3 * vertex + n], static_cast<float>(cell.velocity[n]));
      ASSERT_EQ(force[3 * vertex + n], static_cast<float>(cell.force[n]));
    }
    for (std::size_t t = 0; t < corners.size() / 3; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(connectivity[3 * (triangle + t) + c], corners[3 * t + c] + static_cast<int>(vertex));
      }
      ASSERT_EQ(offsets[triangle + t], static_cast<int>(3 * (triangle + t + 1)));
      ASSERT_EQ(types[triangle + t], 5);
      ASSERT_EQ(ids[triangle + t], id);
      ASSERT_EQ(kinds[triangle + t], cell.type);
      ASSERT_NEAR(larger[triangle + t], 1, 1e-6);
      ASSERT_NEAR(smaller[triangle + t], 1, 1e-6);
    }
    vertex += cell.position.size() / 3;
    triangle += corners.size() / 3;
  }
  EXPECT_EQ(vertex, points.size() / 3);
  EXPECT_EQ(triangle, offsets.size());
  world().barrier();
}

TEST(WriteCells, LeavesNoGapWhereACellHasLeft) {
  const ScratchFolder own("write_cells_left");
  const auto folder = folder_of_rank_zero(own);
  const auto all = array_of<double>(written(folder / "all.vtu", false), "points_um");
  const std::string file = written(folder / "fewer.vtu", false, {4, 0, 6});
  const auto points = array_of<double>(file, "points_um");
  const auto connectivity = array_of<std::int32_t>(file, "connectivity");
  const auto ids = array_of<std::int32_t>(file, "cell_id");
  EXPECT_EQ(attribute(file, "NumberOfPoints", "NumberOfPoints"), std::to_string(points.size() / 3));
  const flow::Setup setup = two_types();
  std::size_t vertex = 0, triangle = 0, in_all = 0;
  for (int id = 0; id < cells; ++id) {
    const CellType& type = setup.types[static_cast<std::size_t>(setup.cells[static_cast<std::size_t>(id)].type)];
    const std::size_t first_in_all = in_all;
    in_all += type.shape.size();
    if (id == 0 || id == 4 || id == 6) continue;
    for (std::size_t n = 0; n < type.shape.size(); ++n) ASSERT_EQ(points[3 * vertex + n], all[first_in_all + n]);
    for (std::size_t n = 0; n < type.triangles.size(); ++n) {
      ASSERT_EQ(connectivity[3 * triangle + n], type.triangles[n] + static_cast<int>(vertex));
      ASSERT_EQ(ids[triangle + n / 3], id);
    }
    vertex += type.shape.size() / 3;
    triangle += type.triangles.size() / 3;
  }
  EXPECT_EQ(vertex, points.size() / 3);
  EXPECT_EQ(triangle, ids.size());
  const std::string none = written(folder / "none.vtu", false, {0, 1, 2, 3, 4, 5, 6});
  EXPECT_EQ(attribute(none, "NumberOfPoints", "NumberOfPoints"), "0");
  EXPECT_TRUE(array_of<double>(none, "points_um").empty());
  world().barrier();
}

TEST(WriteCells, IntoTheBoxMovesByWholePeriods) {
  const ScratchFolder own("write_cells_box");
  const auto folder = folder_of_rank_zero(own);
  const auto free = array_of<double>(written(folder / "free.vtu", false), "points_um");
  const auto boxed = array_of<double>(written(folder / "boxed.vtu", true), "points_um");
  const flow::Setup setup = two_types();
  std::size_t n = 0;
  for (const CellStart& cell : setup.cells) {
    const std::size_t count = setup.types[static_cast<std::size_t>(cell.type)].shape.size();
    double mean = 0;
    for (std::size_t i = n; i < n + count; ++i) {
      EXPECT_NEAR(std::remainder(free[i] - boxed[i], 10.0), 0, 1e-12);
      if (i % 3 == 0) mean += boxed[i] / (static_cast<double>(count) / 3);
    }
    EXPECT_GE(mean, 0);
    EXPECT_LT(mean, 10);
    n += count;
  }
  world().barrier();
}

}  // namespace
}  // namespace npfem::flow
