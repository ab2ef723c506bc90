// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_cells.h"

#include <gtest/gtest.h>

#include "file.h"
#include "quantity.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LineagePlacings, OneBodyPerLine) {
  const auto placings = parse_placings("0,10,10.5,10,90,0,0\r\n1, 1,2,3 ,4,5,-6", "a.pos");
  ASSERT_EQ(placings.size(), 2u);
  EXPECT_EQ(placings[0].centre, (Vec3{10, 10.5, 10}));
  EXPECT_EQ(placings[0].degrees, (Vec3{90, 0, 0}));
  EXPECT_EQ(placings[1].type, 1);
  EXPECT_EQ(placings[1].degrees, (Vec3{4, 5, -6}));
  EXPECT_EQ(error_of([] { parse_placings("0,1,2,3,4,5,6\n2,1,2,3,4,5,6", "a.pos"); }),
            "a.pos:2: the type is 2; 0 (red cell) or 1 (platelet) is needed");
  EXPECT_EQ(error_of([] { parse_placings("0,1,2,3,4,5", "a.pos"); }), "a.pos:1: found 6 numbers; 7 are needed");
  EXPECT_EQ(error_of([] { parse_placings("0,1,2,x,4,5,6", "a.pos"); }),
            "a.pos:1: found \"x\" where a number is needed");
}

class LineageCheckpointTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) {
    text::write_file((folder_.path() / name).string(), content);
  }
  const ScratchFolder folder_{"lineage_checkpoint"};
};

TEST_F(LineageCheckpointTest, StartSet) {
  write("body_ID_0.csv", "1,2,3\r\n4,5,6.5\r\n");
  write("body_ID_1.csv", "-1,2,3\n4,5,6\n");
  const LineageCheckpoint set(folder_.path(), 2);
  EXPECT_EQ(set.iteration(), -1);
  EXPECT_EQ(set.positions(0, 2), (std::vector<double>{1, 2, 3, 4, 5, 6.5}));
  EXPECT_EQ(set.positions(1, 2)[0], -1);
  EXPECT_NE(error_of([&] { set.positions(0, 3); }).find("holds 2 vertices; its body has 3"), std::string::npos);
}

TEST_F(LineageCheckpointTest, NewestCompleteSetOfARunCounts) {
  for (const int iteration : {100, 200}) {
    for (const int body : {0, 1}) {
      char name[80];
      std::snprintf(name, sizeof name, "body_ID_%d_iT_%012d.csv", body, iteration);
      write(name, std::to_string(iteration + body).append(",0,0\n"));
      write(std::string("vels_").append(name), "9,9,9\n");
    }
  }
  write("body_ID_0_iT_000000000300.csv", "300,0,0\n");  // its other body was never written
  write("body_ID_0.csv", "0,0,0\n");
  const LineageCheckpoint set(folder_.path(), 2);
  EXPECT_EQ(set.iteration(), 200);
  EXPECT_EQ(set.positions(1, 1)[0], 201);
}

TEST_F(LineageCheckpointTest, IncompleteSetsAreNamed) {
  write("body_ID_0.csv", "1,2,3\n4,x,6\n");
  EXPECT_EQ(error_of([&] { LineageCheckpoint(folder_.path(), 2); }),
            std::string("\"").append(folder_.path().string()) +
                "\" holds no complete set of 2 bodies: \"body_ID_1.csv\" is missing");
  const LineageCheckpoint set(folder_.path(), 1);
  EXPECT_EQ(error_of([&] { set.positions(0, 2); }),
            (folder_.path() / "body_ID_0.csv").string() + ":2: found \"x\" where a number is needed");
}

}  // namespace
}  // namespace npfem::flow
