// SPDX-License-Identifier: MPL-2.0
// Scenes whose cells start as a cells file has them.
#include <gtest/gtest.h>

#include <fstream>

#include "communicator/serial_communicator.h"
#include "file.h"
#include "geometry/cell_shape.h"
#include "scene/make_cells.h"
#include "scene_text.h"
#include "scratch_folder.h"
#include "simulation/simulation.h"

namespace npfem::flow {
namespace {

class StoredCellsScene : public ::testing::Test {
 protected:
  /// Two red cells, one of them stretched by 10 % along x.
  void SetUp() override {
    Scene scene = parse_scene(shear_scene, "scene.toml");
    make_types(scene);
    const CellType& type = scene.setup.types[0];
    cells_ = {"rbc", type.model->vertices(), hash_of_mesh(type.triangles), {}};
    for (const double stretch : {1.0, 1.1}) {
      for (std::size_t i = 0; i < type.shape.size(); ++i) {
        const Vec3 centre{7, stretch == 1.0 ? 4.0 : 8.0, 5};
        cells_.positions.push_back(centre[i % 3] + (i % 3 == 0 ? stretch : 1.0) * type.shape[i]);
      }
    }
  }

  Scene made(const std::string& change = "count = 1", const std::string& into = "") {
    write_cells_file((folder_.path() / "packed.cells").string(), std::span(&cells_, 1));
    text::write_file((folder_.path() / "scene.toml").string(),
                     with(with(shear_scene, "[run]", "[placement]\nfile = \"packed.cells\"\n[run]"), change, into));
    Scene scene = read_scene((folder_.path() / "scene.toml").string());
    make_types(scene);
    place_scene_cells(scene);
    return scene;
  }

  std::string error_of(const std::string& change = "count = 1", const std::string& into = "") {
    try {
      made(change, into);
    } catch (const text::InputError& error) {
      return shortened(error.what());
    }
    return "no error";
  }

  /// Without the folder, which has another name each time.
  std::string shortened(std::string message) const {
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = 0; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

  const ScratchFolder folder_{"stored_cells"};
  StoredCells cells_;
};

TEST_F(StoredCellsScene, EveryCellStartsAsItStandsInTheFile) {
  const Scene scene = made();
  EXPECT_EQ(cell_counts(scene), (std::vector<int>{2}));
  ASSERT_EQ(scene.setup.cells.size(), 2u);
  EXPECT_NEAR(scene.setup.cells[1].centre[1], 8, 0.05);
  SerialCommunicator self;
  const Simulation simulation(scene.setup, self);
  const std::vector<CellState> states = simulation.local_cells();
  for (std::size_t n = 0; n < 2; ++n) {
    const auto expected = cells_.cell(static_cast<int>(n));
    ASSERT_EQ(states[n].position.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(states[n].position[i], expected[i]);
  }
}

/// Displacements are counted from there.
TEST_F(StoredCellsScene, TheCentreIsTheCentroidOfTheVolumeAlsoOfADeformedCell) {
  for (std::size_t i = 0; i < cells_.positions.size(); i += 3) {  // vertices more to one side than the volume
    double& x = cells_.positions[i];
    if (x > 7) x += 0.05 * (x - 7) * (x - 7);
  }
  const Scene scene = made();
  const std::vector<std::int32_t>& triangles = scene.setup.types[0].triangles;
  for (int n = 0; n < 2; ++n) {
    const auto xyz = cells_.cell(n);
    const Vec3 centroid = shape_of(xyz, triangles).centre;
    double mean_x = 0;
    for (std::size_t i = 0; i < xyz.size(); i += 3) mean_x += xyz[i] / cells_.vertices;
    EXPECT_GT(std::abs(mean_x - centroid[0]), 1e-3) << "um: the two must differ for this test to tell";
    const Vec3 moved = subtract(scene.setup.cells[static_cast<std::size_t>(n)].centre, centroid);
    EXPECT_LT(dot(moved, moved), 1e-20) << "um2";
  }
}

TEST_F(StoredCellsScene, NumbersOfCellsMayStay) {
  EXPECT_EQ(made("count = 1", "haematocrit = 0.4").setup.cells.size(), 2u);
}

TEST_F(StoredCellsScene, TheRecordFindsTheFile) {
  Scene scene = made();
  EXPECT_NE(resolved_text(scene).find("file = \"" + (folder_.path() / "packed.cells").string() + "\""),
            std::string::npos)
      << resolved_text(scene);
}

TEST_F(StoredCellsScene, WhatDoesNotFitIsNamed) {
  EXPECT_EQ(
      error_of("level = 2\ncount = 1"),
      "scene.toml:16:1: cells[0]: the cells \"rbc\" in \"packed.cells\" have another mesh (66 vertices) than this "
      "type (258): take the material and mesh they were made with");
  EXPECT_EQ(error_of("name = \"rbc\"", "name = \"rbcs\""),
            "scene.toml:17:8: cells[0].name: \"packed.cells\" holds no cells \"rbcs\"; did you mean \"rbc\"? it holds: "
            "rbc");
  EXPECT_EQ(error_of("[[cells]]\nname = \"rbc\"\nmaterial = \"rbc\"\nlevel = 2\ncount = 1\n"),
            "scene.toml:18:8: placement.file: \"packed.cells\" holds cells \"rbc\", of which the scene has no "
            "[[cells]] table");
  EXPECT_EQ(error_of("count = 1", "positions = []"),
            "scene.toml:20:13: cells[0].positions: \"placement.file\" says where the cells start; give only one of "
            "them");
  EXPECT_EQ(error_of("packed.cells", "packed.cell"),
            "scene.toml:23:8: placement.file: cannot read \"packed.cell\": no such file");
}

TEST_F(StoredCellsScene, ACellBeyondAWallIsNamed) {
  for (std::size_t i = 1; i < cells_.positions.size(); i += 3) cells_.positions[i] += 3.5;
  const std::string message = error_of();
  EXPECT_EQ(message.find("scene.toml:23:8: placement.file: cell 1 (rbc) at (7, 11.5, 5) um reaches beyond a wall, or "
                         "too near to an opening, at ("),
            0u)
      << message;
}

TEST(StoredCellsOfASetup, WrongNumberOfCoordinatesIsRefused) {
  Scene scene = parse_scene(shear_scene, "scene.toml");
  make_types(scene);
  place_scene_cells(scene);
  scene.setup.cells[0].positions.resize(12);
  SerialCommunicator self;
  EXPECT_THROW(Simulation(scene.setup, self), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
