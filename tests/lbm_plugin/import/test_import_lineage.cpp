// SPDX-License-Identifier: MPL-2.0
// The lineage's own inputs become scenes that mean the same.
#include "import/import_lineage.h"

#include <gtest/gtest.h>
#include <map>

#include <filesystem>
#include <functional>

#include "file.h"
#include "scene/make_cells.h"
#include "scene_text.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

namespace fs = std::filesystem;

const fs::path shared = fs::path(NPFEM_SHARED) / "data" / "palabos-npfem";

/// The lineage's files, to be changed at will.
class ImportLineage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(shared)) GTEST_SKIP() << "no files of the lineage in " << shared;
    for (const char* folder : {"Case_Studies", "wallStlFiles"}) {
      fs::copy(shared / folder, folder_.path() / folder, fs::copy_options::recursive);
    }
    fs::copy(shared / "initialPlacing.pos", folder_.path());
  }

  void change(const std::string& name, const std::string& old, const std::string& replacement) {
    const fs::path path = folder_.path() / name;
    const fs::path source = fs::exists(path) ? path : shared / name;
    text::write_file(path.string(), with(text::read_file(source.string()), old, replacement));
  }

  LineageImport import(const std::string& name, const std::string& coupling = "implicit") {
    if (!fs::exists(folder_.path() / name)) fs::copy(shared / name, folder_.path());
    return import_lineage(folder_.path() / name, folder_.path() / "scene.toml", coupling);
  }

  Scene made(const LineageImport& imported) {
    if (!imported.cells.empty()) write_cells_file((folder_.path() / "scene.cells").string(), imported.cells);
    text::write_file((folder_.path() / "scene.toml").string(), imported.scene);
    Scene scene = read_scene((folder_.path() / "scene.toml").string());
    make_types(scene);
    place_scene_cells(scene);
    return scene;
  }

  std::string error_of(const std::string& name) {
    try {
      import(name);
    } catch (const std::exception& error) {
      std::string message = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (std::size_t at = 0; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
      return message;
    }
    return "no error";
  }

  /// A start set of undeformed red cells at these places.
  void write_start_set(const std::vector<Vec3>& centres, const std::string& ending = "") {
    fs::create_directories(folder_.path() / "CPs");
    const api::Model model =
        api::Model::load_lineage((folder_.path() / "Case_Studies/RBC_Surface_mesh_258SurfVer").string(), 1125, 250);
    const std::vector<double> rest = model.get("rest_position");
    for (std::size_t n = 0; n < centres.size(); ++n) {
      std::string lines;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        char number[32];
        std::snprintf(number, sizeof number, "%g", rest[i] + centres[n][i % 3]);
        lines += number + std::string(i % 3 == 2 ? "\r\n" : ",");
      }
      text::write_file((folder_.path() / "CPs" / ("body_ID_" + std::to_string(n) + ending + ".csv")).string(), lines);
    }
  }

  const ScratchFolder folder_{"import_lineage"};
};

TEST_F(ImportLineage, Obstacle) {
  const Scene scene = made(import("obstacle_params.xml"));
  const flow::Setup& s = scene.setup;
  EXPECT_EQ(s.domain.kind, DomainKind::tube);
  EXPECT_DOUBLE_EQ(s.domain.tube_radius, 9) << "half of 41 - 5 nodes";
  EXPECT_EQ(s.domain.nodes, (std::array<int, 3>{36, 36, 80}));
  EXPECT_DOUBLE_EQ(s.time_step, 0.125);
  EXPECT_DOUBLE_EQ(s.kinematic_viscosity, 1);
  EXPECT_DOUBLE_EQ(s.density, 1025);
  // u = f R^2/(4 rho nu) = 0.05 um/us
  EXPECT_NEAR(s.body_force[2], 4 * 1025 * 0.05 / 81, 1e-12);
  EXPECT_EQ(s.body_force[0], 0);
  EXPECT_EQ(s.coupling.scheme, CouplingScheme::implicit);
  EXPECT_EQ(s.coupling.steps_per_solve, 2);
  ASSERT_EQ(s.domain.solids.size(), 1u);
  EXPECT_EQ(s.domain.wall_distance({9, 9, 16.5}).distance, 1) << "the cube of 5 um about (10, 10, 20) um";
  ASSERT_EQ(s.cells.size(), 1u);
  EXPECT_EQ(s.cells[0].centre, (Vec3{9, 9, 10}));
  EXPECT_NEAR(rotate(s.cells[0].rotation, {0, 0, 1})[1], -1, 1e-15) << "turned about x by 90 degrees";
  EXPECT_EQ(s.types.at(0).model->vertices(), 258);
  EXPECT_EQ(scene.steps, 16000) << "0.002 s";
  EXPECT_EQ(scene.output.cells_every, 100);
  EXPECT_EQ(scene.output.table_every, 2);
}

TEST_F(ImportLineage, ShearFromAStartSet) {
  change("shear_params.xml", "<numRBC> 476 </numRBC>", "<numRBC> 2 </numRBC>");
  change("shear_params.xml", "<numPLT> 95 </numPLT>", "<numPLT> 0 </numPLT>");
  write_start_set({{10, 12, 14}, {-1, 25, 30}});
  const LineageImport imported = import("shear_params.xml");
  const Scene scene = made(imported);
  const flow::Setup& s = scene.setup;
  EXPECT_EQ(s.domain.kind, DomainKind::shear_box);
  EXPECT_EQ(s.domain.nodes, (std::array<int, 3>{100, 96, 100}));
  EXPECT_NEAR(s.domain.wall_velocity(3)[2], 0.5 * 100e-6 * 48, 1e-15) << "along z";
  EXPECT_EQ(s.domain.wall_velocity(3)[0], 0);
  EXPECT_EQ(scene.steps, 4800000) << "0.6 s";
  ASSERT_EQ(s.cells.size(), 2u);
  EXPECT_NEAR(s.cells[0].centre[1], 11, 1e-4) << "the lower wall stands at y = 1 um";
  EXPECT_NEAR(s.cells[1].centre[0], -1, 1e-4) << "unwrapped";
  EXPECT_EQ(s.cells[0].positions.size(), 3u * 258);
  EXPECT_NEAR(s.contact.cells.range, 1, 1e-12);
  EXPECT_NEAR(s.contact.cells.strength, 20 * 1 / (131.8666 / 258), 0.1) << "20 uN/m over 1 um and 0.511 um2";
  EXPECT_NE(imported.scene.find("which shears by 4.17 % more"), std::string::npos);
}

TEST_F(ImportLineage, RunningCheckpointIsTakenAtItsNewestIteration) {
  change("shear_params.xml", "<numRBC> 476 </numRBC>", "<numRBC> 1 </numRBC>");
  change("shear_params.xml", "<numPLT> 95 </numPLT>", "<numPLT> 0 </numPLT>");
  write_start_set({{10, 12, 14}}, "_iT_000000004000");
  write_start_set({{10, 30, 14}}, "_iT_000000008000");
  const LineageImport imported = import("shear_params.xml");
  EXPECT_NEAR(made(imported).setup.cells.at(0).centre[1], 29, 1e-4);
  EXPECT_NE(imported.scene.find("after step 8000"), std::string::npos);
}

TEST_F(ImportLineage, PackingAsksForTheLineagesNumbers) {
  const std::string scene = import("cellPacking_params.xml").scene;
  EXPECT_NE(scene.find("count = 204"), std::string::npos) << "15 % of 125000 um3 over 91.8 um3";
  EXPECT_NE(scene.find("count = 40"), std::string::npos) << "a fifth";
  change("cellPacking_params.xml", "<ht> 15 </ht>", "<ht> 35 </ht>");
  const std::string dense = import("cellPacking_params.xml").scene;
  EXPECT_NE(dense.find("count = 476"), std::string::npos);
  EXPECT_NE(dense.find("count = 95"), std::string::npos);
}

TEST_F(ImportLineage, CouplingOfTheLineageCarriesItsSettings) {
  const Scene scene = made(import("obstacle_params.xml", "lineage"));
  const std::map<std::string, double> option(scene.solver_options.begin(), scene.solver_options.end());
  EXPECT_EQ(scene.setup.coupling.scheme, CouplingScheme::lineage);
  EXPECT_EQ(scene.setup.collision, Collision::regularised);
  EXPECT_TRUE(scene.setup.coupling.lineage_steps);
  EXPECT_EQ(scene.setup.coupling.forcing_iterations, 1);
  EXPECT_EQ(option.at("lineage_alpha"), 0.9);
  EXPECT_EQ(option.at("lineage_beta"), 0.01);
  EXPECT_EQ(option.at("history"), 5);
  EXPECT_EQ(option.at("lineage_window"), 5);
  EXPECT_EQ(option.at("lineage_attempts"), 7);
  EXPECT_EQ(scene.setup.contact.cells.range, 1) << "2 nodes";
  EXPECT_EQ(scene.requests.at(0).body_density, 1125);
  EXPECT_EQ(made(import("obstacle_params.xml")).requests.at(0).body_density, 100) << "beyond the fluid";
}

TEST_F(ImportLineage, PlatesAndTubesWithoutWallFile) {
  change("obstacle_params.xml", "./wallStlFiles/cube5by5by5at10_10_20.stl", "");
  EXPECT_TRUE(made(import("obstacle_params.xml")).setup.domain.solids.empty());
  change("obstacle_params.xml", "Poiseuille_Flow", "Box_Poiseuille_Flow");
  const Scene plates = made(import("obstacle_params.xml"));
  EXPECT_EQ(plates.setup.domain.kind, DomainKind::plates);
  EXPECT_EQ(plates.setup.domain.nodes[1], 37) << "41 - 4 nodes";
  EXPECT_GT(plates.setup.body_force[2], 0);
}

TEST_F(ImportLineage, SizesAreRoundedToWholeSpacings) {
  change("obstacle_params.xml", "<dx_p> 0.5 </dx_p>", "<dx_p> 0.3 </dx_p>");
  const LineageImport imported = import("obstacle_params.xml");
  const Scene scene = made(imported);
  EXPECT_EQ(scene.setup.domain.nodes, (std::array<int, 3>{63, 63, 133})) << "20 um are 67 spacings, 40 um 133";
  EXPECT_NE(imported.scene.find("# - lx_p, ly_p, lz_p are rounded to whole numbers of dx_p"), std::string::npos);
  change("obstacle_params.xml", "./wallStlFiles/cube5by5by5at10_10_20.stl", "");
  change("obstacle_params.xml", "Poiseuille_Flow", "Box_Poiseuille_Flow");
  EXPECT_EQ(made(import("obstacle_params.xml")).setup.domain.nodes, (std::array<int, 3>{67, 64, 133}));
  fs::remove(folder_.path() / "obstacle_params.xml");
  EXPECT_EQ(import("obstacle_params.xml").scene.find("whole number"), std::string::npos);
}

TEST_F(ImportLineage, WallsOfAFileAreRoundedToo) {
  change("shear_params.xml", "<numRBC> 476 </numRBC>", "<numRBC> 1 </numRBC>");
  change("shear_params.xml", "<numPLT> 95 </numPLT>", "<numPLT> 0 </numPLT>");
  change("shear_params.xml", "<dx_p> 0.5 </dx_p>", "<dx_p> 0.35 </dx_p>");
  write_start_set({{10, 12, 14}});
  const LineageImport imported = import("shear_params.xml");
  EXPECT_EQ(made(imported).setup.domain.nodes[1], 137) << "48 um between the planes";
  EXPECT_NE(imported.scene.find("The room between the plates is 47.95 um wide"), std::string::npos);
}

TEST_F(ImportLineage, UnknownKeysAreNoted) {
  EXPECT_EQ(import("obstacle_params.xml").scene.find("without effect"), std::string::npos);
  change("obstacle_params.xml", "<dx_p> 0.5 </dx_p>", "<dx_p> 0.5 </dx_p> <dy_p> 1 </dy_p>");
  EXPECT_NE(import("obstacle_params.xml")
                .scene.find("# - Unknown to the lineage and to this program, without effect: System_Setup/dy_p."),
            std::string::npos);
}

TEST_F(ImportLineage, ANegativeShearRateIsNamed) {
  change("shear_params.xml", "<shear_rate> 100", "<shear_rate> -100");
  EXPECT_NE(error_of("shear_params.xml").find("System_Setup/shear_rate: -100"), std::string::npos);
}

TEST_F(ImportLineage, BadFilesAreNamedWithLineAndKey) {
  struct Bad {
    const char* old;
    const char* replacement;
    const char* message;
  };
  const Bad cases[] = {
      {"Poiseuille_Flow", "Poiseuile_Flow",
       "obstacle_params.xml:3: Simulation_Type: unknown word \"Poiseuile_Flow\"; did you mean \"Poiseuille_Flow\"? "
       "allowed: Shear_Flow, Poiseuille_Flow, Box_Poiseuille_Flow"},
      {"<dx_p> 0.5 </dx_p>", "", "obstacle_params.xml: missing key System_Setup/dx_p"},
      {"<dx_p> 0.5 </dx_p>", "<dx_p> 0,5 </dx_p>",
       "obstacle_params.xml:23: System_Setup/dx_p: found \"0,5\" where a number is needed"},
      {"<tau_lb> 2 </tau_lb>", "<tau_lb> 0.4 </tau_lb>",
       "obstacle_params.xml:24: System_Setup/tau_lb: 0.4 must be greater than 0.5"},
      {"<dt_p> -1 </dt_p>", "<dt_p> 1 </dt_p>",
       "obstacle_params.xml:24: System_Setup/tau_lb: exactly one of tau_lb, dt_p and u_lb must be positive, the others "
       "negative; found 2, 1 and -1"},
      {"initialPlacing.pos", "initial.pos",
       "obstacle_params.xml:11: System_Setup/pos_filename: cannot read \"initial.pos\": no such file"},
      {"cube5by5by5at10_10_20.stl", "cube.stl",
       "obstacle_params.xml:12: System_Setup/wallStlFileName: cannot read \"wallStlFiles/cube.stl\": no such file"},
      {"cube5by5by5at10_10_20.stl", "box20x20x20.stl",
       "obstacle_params.xml:12: System_Setup/wallStlFileName: holds two planes, but Poiseuille_Flow is in a tube"},
      {"RBC_Surface_mesh_258SurfVer", "RBC",
       "obstacle_params.xml:5: Case_Study_RBC: there is no folder \"Case_Studies/RBC\""},
      {"<restartFromCP> false", "<restartFromCP> true",
       "obstacle_params.xml:61: CheckPointing/CP_OutputDir: there is no folder \"CPs/\"; unpack the archive of the "
       "start set there"},
      {"<rho> 1125.0 </rho> <!--> Density of RBC", "<rho> 1000 </rho> <!--> Density of RBC",
       "obstacle_params.xml:94: ShapeOp_RBC/rho: 1000 is less than the density of the fluid, 1025.0: a cell lighter "
       "than the fluid it holds is not allowed"},
      {"<u_p> 0.05 </u_p>", "<u_p> -0.05 </u_p>",
       "obstacle_params.xml:27: System_Setup/u_p: -0.05 must not be negative"},
      {"<lz_p> 40 </lz_p>", "<lz_p> 1 </lz_p>",
       "obstacle_params.xml: gives a scene that cannot be used: the scene made of it:"},
      {"<max_time> 0.002", "<max_time> -1", "obstacle_params.xml:34: System_Setup/max_time: -1 must be greater than 0"},
  };
  for (const Bad& bad : cases) {
    fs::remove(folder_.path() / "obstacle_params.xml");
    change("obstacle_params.xml", bad.old, bad.replacement);
    const std::string message = error_of("obstacle_params.xml");
    EXPECT_EQ(message.substr(0, std::string(bad.message).size()), bad.message) << bad.replacement << "\n" << message;
  }
}

}  // namespace
}  // namespace npfem::flow
