// SPDX-License-Identifier: MPL-2.0
// Every way to get a scene wrong, and the message for it.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene_text.h"

namespace npfem::flow {
namespace {

std::string error_of(const std::string& text, const std::vector<std::string>& assignments = {}) {
  try {
    parse_scene(text, "scene.toml", assignments);
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

struct BadScene {
  const char* name;
  const char* old;  // of shear_scene
  const char* replacement;
  const char* message;
};

void PrintTo(const BadScene& scene, std::ostream* out) {
  *out << scene.name;
}

class BadScenes : public ::testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, AreRefusedWithThisMessage) {
  EXPECT_EQ(error_of(with(shear_scene, GetParam().old, GetParam().replacement)), GetParam().message);
}

const BadScene wrong_words[] = {
    {"MisspeltKey", "shear_rate =", "shear_rat =",
     "scene.toml:14:1: unknown key \"shear_rat\" in [flow]; did you mean \"shear_rate\"? known keys: axis, "
     "centre_velocity, mean_velocity, pressure_gradient, shear_rate, start, waveform"},
    {"MisspeltKeyOfACell", "level = 2", "lvel = 2",
     "scene.toml:19:1: unknown key \"lvel\" in [cells[0]]; did you mean \"level\"? known keys: body_density, "
     "body_folder, count, haematocrit, interior_viscosity_ratio, level, material, mesh, name, positions, pull, "
     "pull_contact, ratio, ratio_to, volume_weight"},
    {"MisspeltSection", "[run]", "[rum]\nsteps = 1\n[run]",
     "scene.toml:22:2: unknown key \"rum\" at the top level; did you mean \"run\"? known keys: cells, contact, "
     "coupling, domain, flow, fluid, lineage, openings, output, placement, quality, run, schema_version, solver, title"},
    {"MisspeltWord", "\"shear_box\"", "\"shearbox\"",
     "scene.toml:5:8: domain.kind: unknown word \"shearbox\"; did you mean \"shear_box\"? allowed: tube, shear_box, "
     "plates, periodic_box, vessel"},
    {"NotToml", "steps = 10", "steps = = 10",
     "scene.toml:23:9: Error while parsing value: could not determine value type"},
    {"Version", "schema_version = 1", "schema_version = 2",
     "scene.toml:1:18: schema_version: this program reads version 1 only"},
    {"NoVersion", "schema_version = 1", "", "scene.toml:1:1: missing key \"schema_version\": an integer is needed"},
};

const BadScene wrong_numbers[] = {
    {"BareNumber", "dx = \"0.5 um\"", "dx = 0.5",
     "scene.toml:7:6: domain.dx: 0.5 has no unit; a length, like \"1 um\" is needed"},
    {"WrongDimension", "\"0.1 us\"", "\"0.1 um\"",
     "scene.toml:11:13: fluid.time_step: \"0.1 um\" is a length, but a time, like \"1 us\" is needed"},
    {"NotFinite", "\"0.5 um\"", "\"nan um\"",
     "scene.toml:7:6: domain.dx: found \"nan um\", but a finite number is needed"},
    {"NegativeViscosity", "\"1.2 mPa s\"", "\"-1.2 mPa s\"",
     "scene.toml:10:21: fluid.dynamic_viscosity: \"-1.2 mPa s\" must be greater than 0"},
    {"NegativeSize", "\"14 um\"", "\"-14 um\"", "scene.toml:6:9: domain.size: \"-14 um\" must be greater than 0"},
    {"TwoSizes", "\"14 um\", ", "",
     "scene.toml:6:8: domain.size: found 2 items, but a list of three, each a length, like \"1 um\" is needed"},
    {"NotAMultipleOfDx", "\"14 um\"", "\"14.2 um\"",
     "scene.toml:6:8: domain.size: 14.2 um is not a whole number of node spacings (dx = 0.5 um); the nearest that are: "
     "14 um and 14.5 um"},
    {"TooFewNodes", "\"14 um\"", "\"1 um\"",
     "scene.toml:6:8: domain.size: 1 um is only 2 node spacings (dx = 0.5 um); at least 4 are needed"},
    {"AbsurdSize", "\"14 um\"", "\"14 m\"",
     "scene.toml:6:8: domain.size: 14000000 um is more than 100000 node spacings (dx = 0.5 um)"},
    {"TauOfOneHalf", "time_step = \"0.1 us\"", "tau = 0.5", "scene.toml:11:7: fluid.tau: 0.5 must be greater than 0.5"},
    {"HugeTimeStep", "\"0.1 us\"", "\"50 us\"",
     "scene.toml:11:13: fluid.time_step: gives a relaxation time of 703 steps, above 50: take a time step below 3.52 "
     "us"},
    {"TooFastForTheLattice", "\"1000 1/s\"", "\"1e7 1/s\"",
     "scene.toml:13:1: flow: the largest velocity, 60000 mm/s, is Mach 20.8 on the lattice, above 0.3: take a time "
     "step below 0.00144 us"},
    {"KernelOfFive", "[run]", "[coupling]\nkernel = 5\n[run]",
     "scene.toml:23:10: coupling.kernel: 5 is not allowed: 2 to 4"},
    {"ContactWithNobody", "[run]", "[[contact.pairs]]\nfirst = \"rbc\"\nsecond = \"platlet\"\n[run]",
     "scene.toml:24:10: contact.pairs[0].second: no type of cells is called \"platlet\"; allowed: rbc, wall"},
    {"ContactTwice", "[run]",
     "[[contact.pairs]]\nfirst = \"rbc\"\nsecond = \"wall\"\n[[contact.pairs]]\nfirst = \"rbc\"\nsecond = "
     "\"wall\"\n[run]",
     "scene.toml:27:10: contact.pairs[1].second: this pair stands there already"},
    {"ContactStrengthAsForce", "[run]", "[contact]\nstrength = \"2 pN\"\n[run]",
     "scene.toml:23:12: contact.strength: \"2 pN\" is a force, but a stress, like \"1 Pa\" is needed"},
    {"NegativeSteps", "steps = 10", "steps = -10", "scene.toml:23:9: run.steps: -10 must not be negative"},
    {"NegativeCount", "count = 1", "count = -1", "scene.toml:20:9: cells[0].count: -1 must not be negative"},
    {"CountAsText", "count = 1", "count = \"1\"",
     "scene.toml:20:9: cells[0].count: found \"1\", but an integer is needed, like 100"},
    {"HaematocritAboveOne", "count = 1", "haematocrit = 1.5",
     "scene.toml:20:15: cells[0].haematocrit: 1.5 must lie between 0 and 1"},
};

const BadScene absurd_numbers[] = {
    {"NoViscosityIsLeft", "time_step", "density = \"1e30 kg/m3\"\ntime_step",
     "scene.toml:10:21: fluid.dynamic_viscosity: with a density of 1e30 kg/m3 and a time step of 0.1 us the "
     "relaxation time of the lattice is no more than 1/2 step, where the viscosity is zero: is the density, the "
     "viscosity or the time step mistyped?"},
    {"MeshFinerThanAnything", "level = 2", "level = 6", "scene.toml:19:9: cells[0].level: 6 is not allowed: 1 to 5"},
};

const BadScene wrong_choices[] = {
    {"TwoViscosities", "time_step", "kinematic_viscosity = \"1 mm2/s\"\ntime_step",
     "scene.toml:10:21: fluid.dynamic_viscosity: \"kinematic_viscosity\" is given too; give only one of them"},
    {"NoTimeStep", "time_step = \"0.1 us\"", "", "scene.toml:9:1: fluid: one of \"time_step\" or \"tau\" is needed"},
    {"NoShearRate", "shear_rate = \"1000 1/s\"", "",
     "scene.toml:13:1: missing key \"flow.shear_rate\": a rate, like \"1 1/s\" is needed"},
    {"DriveOfAnotherKind", "shear_rate = \"1000 1/s\"", "mean_velocity = \"1 mm/s\"",
     "scene.toml:14:17: flow.mean_velocity: a shear box is driven by \"shear_rate\"; for a pressure-driven flow take "
     "the kind plates"},
    {"FlowWithoutWalls", "\"shear_box\"", "\"periodic_box\"",
     "scene.toml:14:14: flow.shear_rate: a periodic box has no walls to drive a flow against; take the kind shear_box, "
     "plates or tube"},
    {"TubeWithASize", "\"shear_box\"", "\"tube\"",
     "scene.toml:6:8: domain.size: a tube has \"diameter\" and \"length\" instead"},
    {"BoxWithADiameter",
     "dx = ", "diameter = \"3 um\"\ndx = ", "scene.toml:7:12: domain.diameter: only a tube has this; give \"size\""},
    {"NoNumberOfCells", "count = 1", "",
     "scene.toml:16:1: cells[0]: one of \"haematocrit\", \"count\", \"ratio\" or \"positions\" is needed"},
    {"TwoNumbersOfCells", "count = 1", "count = 1\nhaematocrit = 0.1",
     "scene.toml:20:9: cells[0].count: \"haematocrit\" is given too; give only one of them"},
    {"RatioToNobody", "count = 1", "ratio = 0.1\nratio_to = \"plt\"",
     "scene.toml:21:12: cells[0].ratio_to: no type \"plt\" stands before this one; allowed: none"},
    {"SameNameTwice", "[run]", "[[cells]]\nname = \"rbc\"\nmaterial = \"rbc\"\ncount = 1\n[run]",
     "scene.toml:23:8: cells[1].name: another type is called \"rbc\" already"},
    {"LevelOfAMeshFile", "level = 2", "level = 2\nmesh = \"cell.off\"",
     "scene.toml:19:9: cells[0].level: \"mesh\" is given too; a mesh file has no level"},
    {"ForcingWithoutTheLineage", "[run]", "[coupling]\nforcing_iterations = 2\n[run]",
     "scene.toml:23:22: coupling.forcing_iterations: is for scheme \"lineage\" only; leave it out"},
    {"TwoViscositiesInside", "count = 1",
     "count = 1\ninterior_viscosity_ratio = 5\n[[cells]]\nname = \"plt\"\nmaterial = \"platelet\"\ncount = "
     "1\ninterior_viscosity_ratio = 2",
     "scene.toml:26:28: cells[1].interior_viscosity_ratio: \"rbc\" has 5; all types for which it is not 1 must have "
     "the "
     "same"},
    {"StepsBeyondTheTime", "steps = 10", "steps = 50\ntime = \"2 us\"",
     "scene.toml:23:9: run.steps: 50 are more than the 20 of \"run.time\", 2 us, which ends the run first; give a "
     "longer time, or no steps"},
    {"MagicOfAnotherCollision", "dynamic_viscosity", "collision = \"bgk\"\nmagic_parameter = 0.2\ndynamic_viscosity",
     "scene.toml:11:19: fluid.magic_parameter: is for collision \"trt\" only, this is \"bgk\"; leave it out"},
    {"SeedBesidePositions", "count = 1",
     "positions = [{centre = [\"7 um\", \"6 um\", \"5 um\"]}]\n[placement]\nseed = 2",
     "scene.toml:22:8: placement.seed: no cell is placed at random, since \"positions\" lists them all; leave this "
     "out"},
    {"GapBesidePositions", "count = 1",
     "positions = [{centre = [\"7 um\", \"6 um\", \"5 um\"]}]\n[placement]\ngap = \"1 um\"",
     "scene.toml:22:7: placement.gap: no cell is placed at random, since \"positions\" lists them all; leave this out"},
    {"AttractionWithoutRange", "[run]", "[contact]\nrange = \"0 um\"\nattraction = \"1 uN/m\"\n[run]",
     "scene.toml:24:14: contact.attraction: acts beyond \"range\", which is 0 and switches the whole contact off: give "
     "a "
     "range above 0, or leave the attraction out"},
    {"AttractionOfAPairWithoutRange", "[run]",
     "[[contact.pairs]]\nfirst = \"rbc\"\nsecond = \"wall\"\nrange = \"0 um\"\nattraction = \"1 uN/m\"\n[run]",
     "scene.toml:26:14: contact.pairs[0].attraction: acts beyond \"range\", which is 0 and switches the whole contact "
     "off: give a range above 0, or leave the attraction out"},
    {"NoEnd", "steps = 10", "", "scene.toml:22:1: run: \"steps\" or \"time\" is needed"},
};

const auto name_of_case = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Words, BadScenes, ::testing::ValuesIn(wrong_words), name_of_case);
INSTANTIATE_TEST_SUITE_P(Numbers, BadScenes, ::testing::ValuesIn(wrong_numbers), name_of_case);
INSTANTIATE_TEST_SUITE_P(Sizes, BadScenes, ::testing::ValuesIn(absurd_numbers), name_of_case);
INSTANTIATE_TEST_SUITE_P(Choices, BadScenes, ::testing::ValuesIn(wrong_choices), name_of_case);

TEST(BadAssignments, NameTheAssignment) {
  EXPECT_EQ(error_of(shear_scene, {"run.stps=3"}),
            "--set run.stps=3: unknown key \"stps\" in [run]; did you mean \"steps\"? known keys: steps, time");
  EXPECT_EQ(error_of(shear_scene, {"fluid.time_step=-1 us"}),
            "--set fluid.time_step=-1 us: fluid.time_step: \"-1 us\" must be greater than 0");
}

}  // namespace
}  // namespace npfem::flow
