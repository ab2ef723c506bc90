// SPDX-License-Identifier: MPL-2.0
// Walls, openings and waveforms that cannot be, and the message for each.
#include <gtest/gtest.h>

#include <ostream>

#include "file.h"
#include "scene/make_cells.h"
#include "scene_text.h"
#include "scratch_folder.h"
#include "stl_surfaces.h"

namespace npfem::flow {
namespace {

const std::string plates_scene = R"(schema_version = 1

[domain]
kind = "plates"
size = ["14 um", "12 um", "10 um"]
dx = "0.5 um"
WALLS
[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"

[flow]
DRIVE

[[cells]]
name = "rbc"
material = "rbc"
level = 2
positions = [{centre = ["5 um", "6 um", "5 um"]}]

[run]
steps = 10
)";

std::string scene_with(const std::string& walls, const std::string& drive = "") {
  return with(with(plates_scene, "WALLS", walls), "DRIVE", drive);
}

std::string error_of(const std::string& text) {
  try {
    Scene scene = parse_scene(text, "scene.toml");
    make_types(scene);
    place_scene_cells(scene);
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

struct BadWall {
  const char* name;
  const char* walls;
  const char* drive;
  const char* message;
};

void PrintTo(const BadWall& wall, std::ostream* out) {
  *out << wall.name;
}

class BadWalls : public ::testing::TestWithParam<BadWall> {};

TEST_P(BadWalls, AreRefusedWithThisMessage) {
  EXPECT_EQ(error_of(scene_with(GetParam().walls, GetParam().drive)), GetParam().message);
}

const BadWall solids[] = {
    {"SoundSlit", "[[domain.solids]]\nshape = \"slit\"\nat = \"12 um\"\nlength = \"2 um\"\nwidth = \"3 um\"", "",
     "no error"},
    {"SlitThatCutsACell", "[[domain.solids]]\nshape = \"slit\"\nlength = \"4 um\"\nwidth = \"3 um\"", "",
     "scene.toml:22:14: cells[0].positions[0]: cell 0 (rbc) at (5, 6, 5) um is outside the walls or across one; move "
     "it, or take it out of the list"},
    {"ObstacleInACell",
     "[[domain.solids]]\nshape = \"box\"\ncentre = [\"5 um\", \"9 um\", \"5 um\"]\nsize = [\"2 um\", \"2 um\", \"2 "
     "um\"]",
     "",
     "scene.toml:22:14: cells[0].positions[0]: cell 0 (rbc) at (5, 6, 5) um is outside the walls or across one; move "
     "it, or take it out of the list"},
    {"UnknownShape", "[[domain.solids]]\nshape = \"ball\"", "",
     "scene.toml:8:9: domain.solids[0].shape: unknown word \"ball\"; allowed: box, sphere, slit, constriction, "
     "surface"},
    {"KeyOfAnotherShape", "[[domain.solids]]\nshape = \"sphere\"\nwidth = \"3 um\"", "",
     "scene.toml:9:9: domain.solids[0].width: a solid of the shape \"sphere\" has none"},
    {"SphereWithoutCentre", "[[domain.solids]]\nshape = \"sphere\"\ndiameter = \"3 um\"", "",
     "scene.toml:7:1: missing key \"domain.solids[0].centre\": a list of three, each a length, like \"1 um\" is "
     "needed"},
    {"SlitWiderThanTheBox", "[[domain.solids]]\nshape = \"slit\"\nlength = \"2 um\"\nwidth = \"12 um\"", "",
     "scene.toml:10:9: domain.solids[0].width: 12 um is not less than the 12 um that the domain has there"},
    {"SlitTooNarrowForTheLattice", "[[domain.solids]]\nshape = \"slit\"\nlength = \"2 um\"\nwidth = \"1.4 um\"", "",
     "scene.toml:10:9: domain.solids[0].width: 1.4 um is less than three node spacings (dx = 0.5 um); take a finer "
     "dx"},
    {"SlitOutsideOfTheBox", "[[domain.solids]]\nshape = \"slit\"\nat = \"15 um\"\nlength = \"2 um\"\nwidth = \"3 um\"",
     "", "scene.toml:9:6: domain.solids[0].at: 15 um is outside of the box, which ends at 14 um"},
    {"ConstrictionLongerThanTheBox",
     "[[domain.solids]]\nshape = \"constriction\"\nlength = \"15 um\"\nwidth = \"6 um\"", "",
     "scene.toml:9:10: domain.solids[0].length: 15 um is more than the 14 um of the box along the flow"},
    {"NoRoomForTheFluid",
     "[[domain.solids]]\nshape = \"box\"\ncentre = [\"7 um\", \"6 um\", \"5 um\"]\nsize = [\"14 um\", \"12 um\", \"10 "
     "um\"]",
     "", "scene.toml:3:1: domain: the walls leave no room for the fluid"},
    {"SurfaceOfAnotherKind", "surface = \"a.stl\"", "",
     "scene.toml:7:11: domain.surface: only a vessel has this; for an obstacle take [[domain.solids]]"},
};

const BadWall openings[] = {
    {"InletWithoutOutlet", "[[openings]]\nface = \"x-\"\nkind = \"velocity\"\nvelocity = \"1 mm/s\"", "",
     "scene.toml:7:1: openings[0]: an inlet without an outlet: what flows in at a given velocity must leave somewhere; "
     "add an opening of the kind \"pressure\""},
    {"OpeningInAWall", "[[openings]]\nface = \"y+\"\nkind = \"pressure\"", "",
     "scene.toml:8:8: openings[0].face: \"y+\" is a wall of this kind of domain"},
    {"TwoOpeningsInAFace",
     "[[openings]]\nface = \"x-\"\nkind = \"pressure\"\n[[openings]]\nface = \"x-\"\nkind = \"pressure\"", "",
     "scene.toml:11:8: openings[1].face: \"x-\" has an opening already"},
    {"InletWithoutVelocity", "[[openings]]\nface = \"x-\"\nkind = \"velocity\"", "",
     "scene.toml:7:1: missing key \"openings[0].velocity\": a velocity, like \"1 mm/s\" is needed"},
    {"PressureOfAVelocityOpening",
     "[[openings]]\nface = \"x-\"\nkind = \"velocity\"\nvelocity = \"1 mm/s\"\npressure = \"1 Pa\"", "",
     "scene.toml:11:12: openings[0].pressure: an opening of the kind \"velocity\" has none"},
    {"ForceBesideOpenings", "[[openings]]\nface = \"x-\"\nkind = \"pressure\"", "mean_velocity = \"1 mm/s\"",
     "scene.toml:15:17: flow.mean_velocity: the openings drive the flow; take this out or them"},
    {"PressureTooHighForTheLattice", "[[openings]]\nface = \"x-\"\nkind = \"pressure\"\npressure = \"5 kPa\"", "",
     "scene.toml:10:12: openings[0].pressure: 5000 Pa changes the density of the lattice fluid by 58.5 %, above 10 %: "
     "take a time step below 0.0413 us"},
    {"ClosedOpening",
     "[[openings]]\nface = \"x-\"\nkind = \"pressure\"\n[[domain.solids]]\nshape = \"box\"\ncentre = [\"0 um\", \"6 "
     "um\", \"5 um\"]\nsize = [\"2 um\", \"12 um\", \"10 um\"]",
     "", "scene.toml:8:8: openings[0].face: the walls leave nothing of this face open"},
    {"CellAcrossAnOpening", "[[openings]]\nface = \"x-\"\nkind = \"pressure\"\n", "",
     "scene.toml:22:14: cells[0].positions[0]: cell 0 (rbc) at (5, 6, 5) um is outside the walls or across one; move "
     "it, or take it out of the list"},
    {"DevelopedWithSolids",
     "[[domain.solids]]\nshape = \"sphere\"\ncentre = [\"11 um\", \"6 um\", \"5 um\"]\ndiameter = \"3 um\"",
     "start = \"developed\"",
     "scene.toml:16:9: flow.start: a developed flow is known only without openings and solids; take \"rest\""},
    {"FlowAcrossThePlates", "", "axis = \"y\"",
     "scene.toml:13:8: flow.axis: the plates stand across y; x or z are allowed"},
};

const BadWall waveforms[] = {
    {"SoundWaveform", "", "[flow.waveform]\nperiod = \"1 ms\"\namplitude = 0.5", "no error"},
    {"PeriodOfAFewSteps", "", "[flow.waveform]\nperiod = \"1.9 us\"\namplitude = 0.5",
     "scene.toml:14:10: flow.waveform.period: 1.9 us is less than 20 times the 0.1 us for which the driving is held "
     "(time_step x cell_every): the flow would not follow the wave; take a longer period, a smaller time step or a "
     "smaller cell_every"},
    {"NoPeriod", "", "[flow.waveform]\namplitude = 0.5",
     "scene.toml:13:1: missing key \"flow.waveform.period\": a time, like \"1 us\" is needed"},
    {"NoShape", "", "[flow.waveform]\nperiod = \"1 ms\"",
     "scene.toml:13:1: flow.waveform: one of \"amplitude\" or \"times\" is needed"},
    {"FewerFactors", "", "[flow.waveform]\nperiod = \"1 ms\"\ntimes = [\"0 ms\", \"0.5 ms\"]\nfactors = [1]",
     "scene.toml:16:11: flow.waveform.factors: found 1 for 2 times; as many are needed"},
    {"TimesThatDoNotAscend", "",
     "[flow.waveform]\nperiod = \"1 ms\"\ntimes = [\"0.5 ms\", \"0.5 ms\"]\nfactors = [1, 2]",
     "scene.toml:15:9: flow.waveform.times: must ascend; the period closes after the last"},
    {"TimeBeyondThePeriod", "", "[flow.waveform]\nperiod = \"1 ms\"\ntimes = [\"0 ms\", \"1 ms\"]\nfactors = [1, 2]",
     "scene.toml:15:9: flow.waveform.times: 1000 us is not below the period of 1000 us"},
};

const auto name_of_case = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Solids, BadWalls, ::testing::ValuesIn(solids), name_of_case);
INSTANTIATE_TEST_SUITE_P(Openings, BadWalls, ::testing::ValuesIn(openings), name_of_case);
INSTANTIATE_TEST_SUITE_P(Waveforms, BadWalls, ::testing::ValuesIn(waveforms), name_of_case);

/// A vessel from the file vessel.stl, in a box of 20 um.
class BadVessels : public ::testing::Test {
 protected:
  std::string error_with(const std::string& stl_bytes, const std::string& change = "", const std::string& into = "") {
    text::write_file((folder_.path() / "vessel.stl").string(), stl_bytes);
    const std::string scene = R"(schema_version = 1
[domain]
kind = "vessel"
size = ["20 um", "20 um", "20 um"]
dx = "0.5 um"
surface = "vessel.stl"
periodic = "z"
[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"
[run]
steps = 1
)";
    text::write_file((folder_.path() / "scene.toml").string(), with(scene, change, into));
    try {
      read_scene((folder_.path() / "scene.toml").string());
    } catch (const text::InputError& error) {
      std::string message = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (std::size_t at = 0; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
      return message;
    }
    return "no error";
  }
  const ScratchFolder folder_{"bad_vessels"};
};

TEST_F(BadVessels, OpenAndClosedOnesAreSound) {
  EXPECT_EQ(error_with(stl::binary(stl::mantle({10, 10, 0}, 6, 20, 32, 16))), "no error");
  EXPECT_EQ(error_with(stl::text(stl::sphere({10, 10, 10}, 6, 24))), "no error");
  EXPECT_EQ(error_with(stl::text(stl::box({4, 4, 0}, {16, 16, 20}))), "no error") << "its lids are dropped";
}

TEST_F(BadVessels, FaultsAreNamedWithTheirPlace) {
  const std::string tube = stl::binary(stl::mantle({10, 10, 0}, 6, 20, 32, 16));
  EXPECT_EQ(error_with(tube, "periodic = \"z\"")
                .find("scene.toml:6:11: domain.surface: \"vessel.stl\" has a hole at "
                      "the edge from ("),
            0u);
  EXPECT_EQ(error_with(tube, "periodic = \"z\"", "surface_unit = \"1 mm\""),
            "scene.toml:6:11: domain.surface: \"vessel.stl\" reaches out of the box at (16000, 10000, 0) um; the box "
            "goes from (0, 0, 0) to (20, 20, 20) um");
  EXPECT_EQ(error_with("nonsense"),
            "scene.toml:6:11: domain.surface: \"vessel.stl\" is not an STL file: it neither begins with \"solid\" nor "
            "has the length that its number of triangles needs; it may be cut short");
  EXPECT_EQ(error_with(tube, "vessel.stl", "vesel.stl"),
            "scene.toml:6:11: domain.surface: cannot read \"vesel.stl\": no such file");
  EXPECT_EQ(error_with(tube, "surface = \"vessel.stl\"\n"),
            "scene.toml:2:1: missing key \"domain.surface\": text in quotes is needed");
}

}  // namespace
}  // namespace npfem::flow
