// SPDX-License-Identifier: MPL-2.0
#include "mesh/lineage_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>

#include "error.h"
#include "mesh/generate.h"
#include "mesh/geometry.h"
#include "mesh/mesh_check.h"
#include "mutate.h"

namespace npfem {
namespace {

const std::string bodies = std::string(NPFEM_SHARED) + "/data/palabos-npfem/Case_Studies/";

LineageFiles tetrahedron() {
  return {"0,0,0\r\n1,0,0\r\n0,1,0\r\n0,0,1\r\n", "0,2,1\n0,1,3\n1,2,3\n0,3,2\n",
          "SurfaceMaterial,0 2 1,27.5,1.0 1.0 35.0 5.0 0.0\nArea,0 1 3,5000.0,1.0 1.0\nBending,0 2 1 3,0.1,1.0 1.0\n",
          "1\n1\n1\n1"};
}

std::string message_of(const LineageFiles& files) {
  try {
    parse_lineage_body(files, "b");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LineageBody, IsReadWithTheNumbersOfTheLineage) {
  const LineageBody body = parse_lineage_body(tetrahedron(), "b");
  EXPECT_NO_THROW(require_valid_surface(body.surface, "b"));
  ASSERT_EQ(body.constraints.size(), 3u);
  EXPECT_EQ(body.constraints[0].type, "SurfaceMaterial");
  EXPECT_EQ(body.constraints[0].ids, (std::vector<int>{0, 2, 1}));
  EXPECT_EQ(body.constraints[0].scalars, (std::vector<double>{1, 1, 35, 5, 0}));
  EXPECT_EQ(body.constraints[2].weight, static_cast<double>(0.1f)) << "single precision, widened";
  EXPECT_NE(body.constraints[2].weight, 0.1);
  EXPECT_EQ(body.on_surface, (std::vector<int>{1, 1, 1, 1}));
}

TEST(LineageBody, TellsTheFileAndTheLine) {
  const auto with = [](auto member, const std::string& content) {
    LineageFiles files = tetrahedron();
    files.*member = content;
    return message_of(files);
  };
  EXPECT_EQ(with(&LineageFiles::points, "0,0\n"), "b/points.csv:1: a vertex is \"x,y,z\"");
  EXPECT_EQ(with(&LineageFiles::points, "0,0,0\n1,inf,0\n"),
            "b/points.csv:2: found \"inf\", but a finite number is needed");
  EXPECT_EQ(with(&LineageFiles::surface_connectivity, "0,2,1\n0,1,4\n"),
            "b/surface_connectivity.csv:2: vertex 4 does not exist; points.csv has 4, numbered from 0");
  EXPECT_EQ(
      with(&LineageFiles::constraints, "Aera,0 1 2,1,1 1\n"),
      "b/constraints.csv:1: unknown type \"Aera\"; did you mean \"Area\"? allowed: SurfaceMaterial, Area, Bending, "
      "Volume, VolumeMaterial, VolumeDamping, EdgeStrainLimiting, TriangleStrainLimiting");
  EXPECT_EQ(with(&LineageFiles::constraints, "Area,0 1 2,1,1\n"),
            "b/constraints.csv:1: Area needs 3 vertices and 2 scalars; found 3 and 1");
  EXPECT_EQ(with(&LineageFiles::constraints, "Area,0 1 1,1,1 1\n"), "b/constraints.csv:1: the row repeats a vertex");
  EXPECT_EQ(with(&LineageFiles::constraints, "Area,0 1 2,-1,1 1\n"), "b/constraints.csv:1: the weight is negative");
  EXPECT_EQ(with(&LineageFiles::constraints, "Area,0 1 2,1e60,1 1\n"),
            "b/constraints.csv:1: found \"1e60\", but a number is needed");
  EXPECT_EQ(with(&LineageFiles::constraints, "Area,0 1 2,1,1 1\n\n"),
            "b/constraints.csv:2: a row is \"Type,vertices,weight,scalars\", four parts between commas");
  EXPECT_EQ(with(&LineageFiles::on_surface, "1\n2\n1\n1\n"),
            "b/onSurfaceParticle.csv:2: a line is 1 (on the surface) or 0 (inside)");
  EXPECT_EQ(with(&LineageFiles::on_surface, "1\n1\n"),
            "b/onSurfaceParticle.csv:2: the file has 2 lines, but points.csv has 4 vertices");
  try {
    read_lineage_body("/nowhere");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::io);
  }
}

TEST(LineageBody, SurvivesRandomDamage) {
  std::mt19937 random(5);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    LineageFiles files = tetrahedron();
    std::string* const parts[] = {&files.points, &files.surface_connectivity, &files.constraints, &files.on_surface};
    *parts[i % 4] = npfem_test::mutated(*parts[i % 4], random);
    try {
      const LineageBody body = parse_lineage_body(files, "b");
      ASSERT_NO_THROW(require_well_formed(body.surface, "b"));
      ASSERT_EQ(body.on_surface.size(), body.surface.positions.size());
      ++accepted;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 19000);
}

/// The largest distance from a vertex of one mesh to the nearest vertex of the other.
double distance(const TriangleMesh& a, const TriangleMesh& b) {
  double worst = 0;
  for (const Point& p : a.positions) {
    double nearest = INFINITY;
    for (const Point& q : b.positions) {
      nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

struct ShippedBody {
  const char* folder;
  const char* shape;
  int level;
  std::size_t vertices, rows;
  double area, volume;
};

class ShippedBodies : public ::testing::TestWithParam<ShippedBody> {};

TEST_P(ShippedBodies, AreReadAndAreOurShapes) {
  const ShippedBody& expected = GetParam();
  if (!std::filesystem::exists(bodies + expected.folder)) GTEST_SKIP() << "no lineage data at " << bodies;
  const LineageBody body = read_lineage_body(bodies + expected.folder);
  EXPECT_EQ(body.surface.positions.size(), expected.vertices);
  EXPECT_EQ(body.constraints.size(), expected.rows);
  EXPECT_EQ(std::count(body.on_surface.begin(), body.on_surface.end(), 1), static_cast<int>(expected.vertices));
  EXPECT_NO_THROW(require_valid_surface(body.surface, expected.folder));
  EXPECT_NEAR(surface_area(body.surface), expected.area, 5e-5);
  EXPECT_NEAR(signed_volume(body.surface), expected.volume, 5e-5);
  EXPECT_LT(distance(generate_mesh(expected.shape, expected.level), body.surface), 1e-6) << "um";

  // Bending rows are our hinges, whatever their order.
  std::set<std::pair<int, int>> edges;
  for (const auto& [a, b] : find_edges(body.surface)) edges.emplace(a, b);
  std::size_t bending = 0;
  for (const LineageConstraint& row : body.constraints) {
    if (row.type != "Bending") continue;
    ++bending;
    EXPECT_TRUE(edges.contains(std::minmax(row.ids[0], row.ids[1])));
  }
  EXPECT_EQ(bending, edges.size());
}

INSTANTIATE_TEST_SUITE_P(
    Lineage, ShippedBodies,
    ::testing::Values(ShippedBody{"RBC_Surface_mesh_258SurfVer", "rbc", 3, 258, 1792, 131.8666, 91.7992},
                      ShippedBody{"PLT_Larger_Surface_mesh_66SurfVer", "platelet", 2, 66, 448, 22.9932, 6.80319}),
    [](const auto& body) { return std::string(body.param.shape); });

}  // namespace
}  // namespace npfem
