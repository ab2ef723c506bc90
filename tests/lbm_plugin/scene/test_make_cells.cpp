// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "geometry/cell_shape.h"
#include "scene/make_cells.h"
#include "scene_text.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

Scene made(const std::string& text) {
  Scene scene = parse_scene(text, "scene.toml");
  make_types(scene);
  place_scene_cells(scene);
  return scene;
}

std::string error_of(const std::string& text) {
  try {
    made(text);
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MakeCells, ShapeIsTheRelaxedCellAboutTheOrigin) {
  const Scene scene = made(shear_scene);
  const CellType& type = scene.setup.types.at(0);
  EXPECT_EQ(type.name, "rbc");
  EXPECT_EQ(type.shape.size(), 3u * 66);
  const CellShape shape = shape_of(type.shape, type.triangles);
  for (const double x : shape.centre) EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_NEAR(std::abs(shape.normal[2]), 1, 1e-6);

  api::Batch cell(*type.model, "reference", 1);
  cell.write("position", 0, 1, type.shape);
  cell.evaluate();
  std::vector<double> force(type.shape.size());
  cell.read("elastic_force", 0, 1, force);
  for (const double f : force) EXPECT_LT(std::abs(f), 0.01) << "pN: a cell left alone stays as it is";
}

TEST(MakeCells, HaematocritIsMetWithinHalfACell) {
  const Scene scene = made(with(with(shear_scene, "count = 1", "haematocrit = 0.2"), "\"10 um\"]", "\"20 um\"]"));
  const double cell = enclosed_volume(scene.setup.types[0].shape, scene.setup.types[0].triangles);
  const double asked = 0.2 * scene.setup.domain.fluid_volume();
  EXPECT_LE(std::abs(static_cast<double>(scene.setup.cells.size()) * cell - asked), 0.5 * cell);
  const auto counts = cell_counts(scene);
  EXPECT_DOUBLE_EQ(haematocrit_by_type(scene.setup, counts)[0], counts[0] * cell / scene.setup.domain.fluid_volume());
}

TEST(MakeCells, RatioCountsCellsOfAnotherType) {
  const std::string platelets =
      "[[cells]]\nname = \"platelet\"\nmaterial = \"platelet\"\nlevel = 2\nratio = 0.5\nratio_to = \"rbc\"\n[run]";
  const Scene scene =
      made(with(with(with(shear_scene, "count = 1", "count = 4"), "[run]", platelets), "\"10 um\"]", "\"20 um\"]"));
  EXPECT_EQ(cell_counts(scene), (std::vector<int>{4, 2}));
  ASSERT_EQ(scene.setup.cells.size(), 6u);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(scene.setup.cells[n].type, n < 4 ? 0 : 1);
}

TEST(MakeCells, SolverOptionsReachTheCells) {
  const Scene scene = made(with(shear_scene, "[run]", "[solver]\ntolerance = \"1e-3 pN\"\nmax_iterations = 77\n[run]"));
  const std::vector<std::pair<std::string, double>> expected{
      {"tolerance", 1e-3}, {"max_iterations", 77}, {"precision", 0}};
  EXPECT_EQ(scene.setup.types.at(0).options, expected);
}

TEST(MakeCells, MeshAndMaterialFromFiles) {
  const ScratchFolder folder("make_cells");
  api::Mesh::generate("sphere", 2, 3.0).save((folder.path() / "ball.off").string());
  const std::string mesh = "mesh = \"" + (folder.path() / "ball.off").string() + "\"";
  const Scene scene = made(with(shear_scene, "level = 2", mesh));
  EXPECT_NEAR(enclosed_volume(scene.setup.types[0].shape, scene.setup.types[0].triangles), 4.0 / 3 * M_PI * 3.375, 1.5);
}

TEST(MakeCells, NamesWhatCannotBeUsed) {
  EXPECT_EQ(error_of(with(shear_scene, "material = \"rbc\"", "material = \"rcb\"")),
            "scene.toml:18:12: cells[0].material: npfem_material_preset: unknown material \"rcb\"; did you mean "
            "\"rbc\"? allowed: rbc, rbc-viscous, platelet, palabos-rbc, palabos-platelet");
  EXPECT_EQ(error_of(with(shear_scene, "material = \"rbc\"", "material = \"nosuch.toml\"")),
            "scene.toml:18:12: cells[0].material: npfem_material_load: cannot read \"nosuch.toml\": no such file");
  EXPECT_EQ(error_of(with(shear_scene, "level = 2", "mesh = \"none.off\"")),
            "scene.toml:19:8: cells[0].mesh: npfem_mesh_load: cannot read \"none.off\": no such file");
  const std::string viscous = with(shear_scene, "material = \"rbc\"", "material = \"rbc-viscous\"");
  EXPECT_EQ(error_of(with(viscous, "[run]", "[coupling]\nscheme = \"peskin\"\n[run]")),
            "scene.toml:18:12: cells[0].material: has a membrane_shear_viscosity above 0, which coupling.scheme = "
            "\"peskin\" does not know; take \"implicit\", or a material without it");
  EXPECT_EQ(error_of(viscous), "no error");
}

TEST(MakeCells, NamesCellsThatCannotStandWhereTheyAre) {
  EXPECT_EQ(error_of(with(shear_scene, "count = 1",
                          "positions = [{centre = [\"7 um\", \"6 um\", \"5 um\"]},\n {centre = [\"9 um\", \"6 um\", "
                          "\"5 um\"]}]")),
            "scene.toml:21:2: cells[0].positions[1]: cell 1 (rbc) at (9, 6, 5) um is overlapping cell 0 (rbc); move "
            "it, or take it out of the list");
  EXPECT_EQ(error_of(with(shear_scene, "count = 1", "positions = [{centre = [\"7 um\", \"11.5 um\", \"5 um\"]}]")),
            "scene.toml:20:14: cells[0].positions[0]: cell 0 (rbc) at (7, 11.5, 5) um is outside the walls or across "
            "one; move it, or take it out of the list");
}

TEST(MakeCells, SaysWhichHaematocritCannotBeReached) {
  const std::string message = error_of(with(shear_scene, "count = 1", "haematocrit = 0.9"));
  EXPECT_TRUE(message.starts_with("scene.toml: placement: no room for ")) << message;
  EXPECT_NE(message.find(" cells (haematocrit 0.9"), std::string::npos) << message;
  EXPECT_NE(message.find("lower the haematocrit or placement.gap (now 0.3 um), take a larger domain, or pack"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace npfem::flow
