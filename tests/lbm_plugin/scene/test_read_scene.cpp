// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "geometry/vec3.h"
#include "scene/scene.h"
#include "scene/scene_keys.h"
#include "scene_text.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

Scene parsed(const std::string& text, const std::vector<std::string>& assignments = {}) {
  return parse_scene(text, "scene.toml", assignments);
}

TEST(ReadScene, TurnsEverythingIntoBaseUnits) {
  const Scene scene = parsed(shear_scene);
  const flow::Setup& setup = scene.setup;
  EXPECT_EQ(scene.title, "test");
  EXPECT_EQ(setup.domain.kind, DomainKind::shear_box);
  EXPECT_EQ(setup.domain.nodes, (std::array<int, 3>{28, 24, 20}));
  EXPECT_DOUBLE_EQ(setup.domain.dx, 0.5);
  EXPECT_DOUBLE_EQ(setup.domain.plate_speed, 1e-3 * 12);  // 1000/s = 1e-3/us
  EXPECT_DOUBLE_EQ(setup.density, 1025);
  EXPECT_DOUBLE_EQ(setup.kinematic_viscosity, 1200.0 / 1025);
  EXPECT_DOUBLE_EQ(setup.time_step, 0.1);
  EXPECT_DOUBLE_EQ(setup.magic_parameter, 3.0 / 16);
  EXPECT_FALSE(setup.start_developed);
  EXPECT_EQ(setup.coupling.scheme, CouplingScheme::implicit);
  EXPECT_EQ(setup.coupling.kernel_points, 4);
  EXPECT_DOUBLE_EQ(setup.contact.cells.range, 0.5);  // dx
  EXPECT_EQ(scene.steps, 10);
  EXPECT_EQ(scene.requests.at(0).count, 1);
  EXPECT_EQ(scene.requests.at(0).level, 2);
  EXPECT_DOUBLE_EQ(scene.flow.shear_rate.value(), 1e-3);
  EXPECT_DOUBLE_EQ(scene.flow.velocity.value(), 6e-3);
}

TEST(ReadScene, ContactsBearTheStressOfTheFlow) {
  // Plasma of 1.2 mPa s at 2000 1/s: 2.4 Pa.
  const ContactSettings fast = parsed(shear_scene, {"flow.shear_rate=2000 1/s"}).setup.contact;
  EXPECT_DOUBLE_EQ(fast.cells.strength, 30 * 2.4);
  EXPECT_DOUBLE_EQ(fast.walls.strength, 30 * 2.4);
  EXPECT_DOUBLE_EQ(parsed(shear_scene, {"flow.shear_rate=50 1/s"}).setup.contact.cells.strength, 50);
  EXPECT_DOUBLE_EQ(parsed(shear_scene, {"flow.shear_rate=90000 1/s"}).setup.contact.cells.strength, 500);
  const ContactSettings given = parsed(shear_scene, {"contact.strength=7 Pa"}).setup.contact;
  EXPECT_DOUBLE_EQ(given.cells.strength, 7);
  EXPECT_DOUBLE_EQ(given.walls.strength, 50);
}

TEST(ReadScene, TauSetsTheTimeStep) {
  const Scene scene = parsed(with(shear_scene, "time_step = \"0.1 us\"", "tau = 1.1"));
  const double nu = 1200.0 / 1025;
  EXPECT_NEAR(scene.setup.time_step, (1.1 - 0.5) / 3 * 0.25 / nu, 1e-15);
}

TEST(ReadScene, QualityFillsInWhatIsLeftOut) {
  const std::string bare = with(with(shear_scene, "dx = \"0.5 um\"", ""), "time_step = \"0.1 us\"", "");
  Scene fast = parsed(bare, {"quality=fast"});
  EXPECT_EQ(fast.setup.domain.dx, 0.5);
  EXPECT_EQ(fast.setup.fluid_precision, FluidPrecision::in_float);
  EXPECT_EQ(fast.setup.coupling.kernel_points, 3);
  EXPECT_NE(resolved_text(fast).find("dx = \"0.5 um\""), std::string::npos);
  const Scene balanced = parsed(bare, {"quality=balanced"}), accurate = parsed(bare, {"quality=accurate"});
  EXPECT_EQ(balanced.setup.coupling.steps_per_solve, 2);
  EXPECT_GT(balanced.setup.domain.dx, accurate.setup.domain.dx);
  EXPECT_GT(fast.setup.time_step, balanced.setup.time_step);
  EXPECT_EQ(accurate.setup.fluid_precision, FluidPrecision::in_double);
  EXPECT_EQ(accurate.setup.coupling.kernel_points, 4);
}

TEST(ReadScene, InsetIsTheKernelsOwnWhereItIsLeftOut) {
  EXPECT_FALSE(parsed(shear_scene).setup.coupling.inset.has_value());
  EXPECT_EQ(parsed(shear_scene, {"coupling.inset=0"}).setup.coupling.inset, 0.0);
  EXPECT_EQ(parsed(shear_scene, {"coupling.inset=0.3"}).setup.coupling.inset, 0.3);
  EXPECT_THROW(parsed(shear_scene, {"coupling.inset=1.5"}), text::InputError);
  EXPECT_THROW(parsed(shear_scene, {"coupling.inset=-0.1"}), text::InputError);
  EXPECT_THROW(parsed(shear_scene, {"coupling.scheme=lineage", "coupling.inset=0.3"}), text::InputError);
}

TEST(ReadScene, QualityLeavesWhatTheSceneSays) {
  const Scene scene = parsed(shear_scene, {"quality=accurate", "coupling.kernel=2"});
  EXPECT_EQ(scene.setup.domain.dx, 0.5);
  EXPECT_EQ(scene.setup.time_step, 0.1);
  EXPECT_EQ(scene.setup.coupling.kernel_points, 2);
  EXPECT_THROW(parsed(shear_scene, {"quality=best"}), text::InputError);
}

/// A tube driven by G: mean velocity G R^2 / (8 mu); plates: G H^2 / (12 mu). Three ways to say the same.
TEST(ReadScene, DrivesThePlainFluidAtTheVelocityAskedFor) {
  const std::string tube = with(with(shear_scene, "kind = \"shear_box\"\nsize = [\"14 um\", \"12 um\", \"10 um\"]",
                                     "kind = \"tube\"\ndiameter = \"20 um\"\nlength = \"30 um\""),
                                "shear_rate = \"1000 1/s\"", "DRIVE\nstart = \"developed\"");
  const Scene mean = parsed(with(tube, "DRIVE", "mean_velocity = \"10 mm/s\""));
  const Scene centre = parsed(with(tube, "DRIVE", "centre_velocity = \"20 mm/s\""));
  const double gradient = 8 * 1200.0 * 0.01 / 100;  // Pa/um
  EXPECT_NEAR(mean.setup.body_force[2], gradient, 1e-12);
  EXPECT_NEAR(centre.setup.body_force[2], gradient, 1e-12);
  EXPECT_NEAR(mean.flow.velocity.value(), 0.02, 1e-15);
  EXPECT_NEAR(mean.flow.shear_rate.value(), 4 * 0.01 / 10, 1e-15);
  EXPECT_TRUE(mean.setup.start_developed);
  const Scene by_pressure = parsed(with(tube, "DRIVE", "pressure_gradient = \"0.96 MPa/m\""));
  EXPECT_NEAR(by_pressure.setup.body_force[2], 0.96, 1e-12);

  const Scene plates =
      parsed(with(with(shear_scene, "shear_box", "plates"), "shear_rate = \"1000 1/s\"", "mean_velocity = \"6 mm/s\""));
  EXPECT_NEAR(plates.setup.body_force[0], 12 * 1200.0 * 0.006 / 144, 1e-12);
  EXPECT_NEAR(plates.flow.velocity.value(), 0.009, 1e-15);
}

const std::string plates_scene = with(shear_scene, "shear_box", "plates");

/// Through a slit of 6 um x 10 um in a channel of 12 um x 10 um the mean velocity doubles.
TEST(ReadScene, EstimatesTheFlowByTheNarrowestSection) {
  const std::string slit = "[[domain.solids]]\nshape = \"slit\"\nlength = \"2 um\"\nwidth = \"6 um\"\n[fluid]";
  const std::string in_and_out =
      "[[openings]]\nface = \"x-\"\nkind = \"velocity\"\nvelocity = \"2 mm/s\"\n"
      "[[openings]]\nface = \"x+\"\nkind = \"pressure\"\n[flow]";
  const Scene scene =
      parsed(with(with(with(plates_scene, "[fluid]", slit), "[flow]", in_and_out), "shear_rate = \"1000 1/s\"", ""));
  EXPECT_TRUE(scene.flow.estimated);
  EXPECT_NEAR(scene.flow.velocity.value(), 1.5 * 0.004, 0.0001);
  EXPECT_NEAR(scene.flow.shear_rate.value(), 6 * 0.004 / 6, 0.1 * 0.004);
  EXPECT_TRUE(scene.warnings.empty());

  const Scene driven =
      parsed(with(with(plates_scene, "[fluid]", slit), "shear_rate = \"1000 1/s\"", "mean_velocity = \"1 mm/s\""));
  EXPECT_NEAR(driven.setup.body_force[0], 12 * 1200.0 * 0.001 / 144, 1e-12) << "that of the empty channel";
  // 12 of 14 um at 12 um, 2 um at 6 um, where the resistance per length is 8 times as high
  EXPECT_NEAR(driven.flow.velocity.value(), 1.5 * 2 * 0.001 * 14 / (12 + 16), 0.05 * 0.0015);
  ASSERT_EQ(driven.warnings.size(), 1u);
  EXPECT_EQ(
      driven.warnings[0].find("scene.toml:18:17: flow.mean_velocity: the force, 0.1 MPa/m, is that of the channel "
                              "without the solids in it; with them expect a mean velocity of roughly 0.501 mm/s"),
      0u)
      << driven.warnings[0];
}

TEST(ReadScene, DoesNotClaimToKnowAnyFlow) {
  const std::string ball =
      "[[domain.solids]]\nshape = \"sphere\"\ncentre = [\"7 um\", \"6 um\", \"5 um\"]\ndiameter = \"5 um\"\n[fluid]";
  const Scene shear = parsed(with(shear_scene, "[fluid]", ball));
  EXPECT_FALSE(shear.flow.shear_rate.has_value());
  const std::string around_a_corner =
      "[[openings]]\nface = \"x-\"\nkind = \"velocity\"\nvelocity = \"2 mm/s\"\n"
      "[[openings]]\nface = \"z+\"\nkind = \"pressure\"\n[flow]";
  const Scene corner = parsed(with(with(plates_scene, "[flow]", around_a_corner), "shear_rate = \"1000 1/s\"", ""));
  EXPECT_FALSE(corner.flow.velocity.has_value());
  EXPECT_FALSE(corner.flow.shear_rate.has_value());
}

TEST(ReadScene, AssignmentsChangeValues) {
  const Scene scene = parsed(shear_scene, {"run.steps=3", "fluid.time_step=0.2 us", "cells[0].count=2"});
  EXPECT_EQ(scene.steps, 3);
  EXPECT_DOUBLE_EQ(scene.setup.time_step, 0.2);
  EXPECT_EQ(scene.requests.at(0).count, 2);
}

TEST(ReadScene, EndsAtStepsOrTime) {
  EXPECT_EQ(parsed(with(shear_scene, "steps = 10", "time = \"2 us\"")).steps, 20);
  EXPECT_EQ(parsed(with(shear_scene, "steps = 10", "time = \"2 us\""), {"run.steps=7"}).steps, 7);
}

TEST(ReadScene, OutputTimesBecomeSteps) {
  const Scene scene = parsed(shear_scene + "\n[output]\ncells_every = \"0.5 us\"\nfluid_every = \"0.01 us\"\n");
  EXPECT_EQ(scene.output.cells_every, 5);
  EXPECT_EQ(scene.output.fluid_every, 1);  // at least one step
  EXPECT_EQ(scene.output.table_every, 0);
}

TEST(ReadScene, PositionsTurnAboutFixedAxes) {
  const Scene scene = parsed(with(shear_scene, "count = 1",
                                  "positions = [{centre = [\"7 um\", \"6 um\", \"5 um\"]}, {centre = [\"1 um\", \"2 "
                                  "um\", \"3 um\"], rotate = [\"90 deg\", \"0 deg\", \"90 deg\"]}]"));
  const auto& positions = scene.requests.at(0).positions;
  ASSERT_EQ(positions.size(), 2u);
  EXPECT_EQ(positions[0].rotation, identity_rotation);
  EXPECT_EQ(positions[1].centre, (Vec3{1, 2, 3}));
  const Vec3 axis = rotate(positions[1].rotation, {0, 0, 1});
  EXPECT_NEAR(axis[0], 1, 1e-15);
}

TEST(ReadScene, ResolvedSceneHoldsDefaultsAndReadsBackTheSame) {
  Scene scene = parsed(shear_scene, {"run.steps=3"});
  const std::string resolved = resolved_text(scene);
  EXPECT_NE(resolved.find("gap = \"0.3 um\""), std::string::npos) << resolved;
  EXPECT_NE(resolved.find("density = \"1025 kg/m3\""), std::string::npos);
  EXPECT_NE(resolved.find("steps = 3"), std::string::npos);
  Scene again = parsed(resolved);
  EXPECT_EQ(resolved_text(again), resolved);
  EXPECT_EQ(again.setup.kinematic_viscosity, scene.setup.kinematic_viscosity);
  EXPECT_EQ(again.setup.domain.plate_speed, scene.setup.domain.plate_speed);
}

TEST(ReadScene, FilesAreFoundFromTheScene) {
  const ScratchFolder folder("scene");
  std::ofstream(folder.path() / "scene.toml") << with(shear_scene, "material = \"rbc\"", "material = \"my/soft.toml\"");
  Scene scene = read_scene((folder.path() / "scene.toml").string());
  const std::string expected = (folder.path() / "my/soft.toml").string();
  EXPECT_TRUE(scene.requests.at(0).material_is_file);
  EXPECT_EQ(scene.requests.at(0).material, expected);
  EXPECT_NE(resolved_text(scene).find(expected), std::string::npos) << "the record must find its files";
}

TEST(SceneReference, ListsEveryKeyWithItsDefault) {
  const std::string page = scene_reference();
  for (const char* word : {"`schema_version`", "`shear_rate`", "`haematocrit`", "`0.3 um`", "`cell_every`", "[[cells]]",
                           "[[cells.positions]]", "`into_box`", "`wall_strength`", "`residual_bound`"}) {
    EXPECT_NE(page.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace npfem::flow
