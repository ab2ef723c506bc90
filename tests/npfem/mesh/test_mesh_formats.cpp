// SPDX-License-Identifier: MPL-2.0
#include "mesh/mesh_formats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "error.h"
#include "mesh/generate.h"
#include "mesh/geometry.h"
#include "mesh/mesh_check.h"
#include "mesh/read_mesh.h"
#include "mutate.h"

namespace npfem {
namespace {

using Parser = TriangleMesh (*)(std::string_view, const std::string&);
using Writer = std::string (*)(const TriangleMesh&);

std::string message_of(Parser parse, std::string_view content) {
  try {
    parse(content, "f");
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_input);
    return error.what();
  }
  return "";
}

constexpr const char* off_text =
    "OFF # a comment\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3 0.5 0.5 1\n3 0 3 2\n";
constexpr const char* obj_text =
    "# tetrahedron\no t\nv 0 0 0\nv 1 0 0\r\nv 0 1 0\nv 0 0 1 1.0\nvn 0 0 1\nf 1 3 2\nf 1/1 2/1 4/1\nf 2//1 3//1 4//1\n"
    "f -4 -1 -2\n";
constexpr const char* stl_text =
    "solid t\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex -0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n";
constexpr const char* ply_text =
    "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nelement face 4\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int a\n"
    "end_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n0 0 1 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n7\n";

TEST(MeshFormats, ReadATetrahedron) {
  for (const auto& [parse, content] : {std::pair<Parser, const char*>{parse_off, off_text},
                                       {parse_obj, obj_text},
                                       {parse_stl, stl_text},
                                       {parse_ply, ply_text}}) {
    const TriangleMesh mesh = parse(content, "f");
    EXPECT_EQ(mesh.positions.size(), 4u) << content;
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 1.0 / 6) << content;
    EXPECT_NO_THROW(require_valid_surface(mesh, "f"));
  }
}

TEST(MeshFormats, ComeBackAsTheyWere) {
  TriangleMesh mesh = evans_fung_cell(3);
  for (const auto& [parse, format] :
       {std::pair<Parser, Writer>{parse_off, format_off}, {parse_obj, format_obj}, {parse_ply, format_ply}}) {
    const TriangleMesh back = parse(format(mesh), "f");
    EXPECT_EQ(back.positions, mesh.positions) << "every bit";
    EXPECT_EQ(back.triangles, mesh.triangles);
  }
  const TriangleMesh single = parse_stl(format_stl(mesh), "f");
  EXPECT_EQ(single.positions.size(), mesh.positions.size());
  EXPECT_NO_THROW(require_valid_surface(single, "f"));
  EXPECT_NEAR(surface_area(single) / surface_area(mesh), 1, 1e-6) << "single precision";
  EXPECT_EQ(parse_stl(format_stl(single), "f").positions, single.positions) << "no further loss";
}

TEST(MeshFormats, TellTheLine) {
  EXPECT_EQ(message_of(parse_off, "OBJ\n"), "f:1: found \"OBJ\", but the file must start with OFF");
  EXPECT_EQ(message_of(parse_off, "OFF\n4 4 6\n0 0 0\n1 0 x\n"), "f:4: found \"x\", but a number is needed");
  EXPECT_EQ(message_of(parse_off, "OFF\n1 1 0\n0 nan 0\n"), "f:3: found \"nan\", but a finite number is needed");
  EXPECT_EQ(message_of(parse_off, "OFF\n2 1 0\n0 0 0\n"), "f:3: the file ends where a vertex should follow");
  EXPECT_EQ(message_of(parse_off, "OFF\n2000000000 1 0\n"),
            "f:2: the count 2000000000 does not fit a file of 19 bytes");
  EXPECT_EQ(message_of(parse_off, "OFF\n99999999999 1 0\n"), "f:2: found \"99999999999\", but an integer is needed");
  EXPECT_EQ(message_of(parse_off, std::string(off_text) + "junk\n"), "f:11: found \"junk\" after the last face");
  EXPECT_NE(message_of(parse_off, "OFF\n1 1 0\n0 0 0\n4 0 0 0 0\n").find("triangulate first"), std::string::npos);
  EXPECT_EQ(message_of(parse_off, "OFF\n1 1 0\n0 0 0\n3 0 0 7\n"),
            "mesh \"f\": triangle 0 refers to vertex 7, but there are 1 vertices, numbered from 0");

  EXPECT_EQ(message_of(parse_obj, "v 0 0 0\nf 1 1 2\n"),
            "f:2: the face refers to vertex 2, but there are 1 before this line, numbered from 1");
  EXPECT_NE(message_of(parse_obj, "v 0 0 0\nf 0 1 1\n").find("vertex 0"), std::string::npos);
  EXPECT_EQ(message_of(parse_obj, "w 1\n"), "f:1: unknown keyword \"w\"; a mesh has lines v and f");
  EXPECT_NE(message_of(parse_obj, ""), "");

  EXPECT_NE(message_of(parse_stl, "").find("neither a text STL"), std::string::npos);
  EXPECT_EQ(message_of(parse_stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
            "f:4: found \"vertex 0 0\", but \"vertex\" is expected");
  EXPECT_EQ(message_of(parse_stl, "solid\n"), "f:1: the file ends where a facet or endsolid should follow");

  EXPECT_EQ(message_of(parse_ply, "plx\n"), "f:1: the file must start with ply");
  EXPECT_NE(message_of(parse_ply, "ply\nformat binary_big_endian 1.0\n").find("f:2: "), std::string::npos);
  EXPECT_NE(message_of(parse_ply, "ply\nformat ascii 1.0\nend_header\n").find("no property \"x\""), std::string::npos);
  EXPECT_EQ(message_of(parse_ply, std::string(ply_text) + "8\n"),
            "f:23: there is more in the file than the header says");
}

TEST(MeshFormats, RefuseCutBinaryFiles) {
  const TriangleMesh mesh = octahedral_sphere(1);
  for (const auto& [parse, content] :
       {std::pair<Parser, std::string>{parse_stl, format_stl(mesh)}, {parse_ply, format_ply(mesh)}}) {
    for (std::size_t size = 0; size < content.size(); size += 7) {
      EXPECT_NE(message_of(parse, std::string_view(content).substr(0, size)), "") << size;
    }
    EXPECT_NE(message_of(parse, content + "x"), "");
  }
}

TEST(MeshFormats, RefuseNumbersThatAreNotFinite) {
  TriangleMesh mesh = octahedral_sphere(1);
  mesh.positions[3][1] = std::nan("");
  EXPECT_NE(message_of(parse_stl, format_stl(mesh)).find("not finite"), std::string::npos);
  EXPECT_EQ(message_of(parse_ply, format_ply(mesh)), "mesh \"f\": vertex 3 has a coordinate that is not finite");
}

TEST(MeshFormats, SurviveRandomDamage) {
  const TriangleMesh mesh = octahedral_sphere(1);
  const std::pair<Parser, std::string> cases[] = {{parse_off, off_text},         {parse_obj, obj_text},
                                                  {parse_stl, stl_text},         {parse_ply, ply_text},
                                                  {parse_stl, format_stl(mesh)}, {parse_ply, format_ply(mesh)}};
  std::mt19937 random(4);
  for (const auto& [parse, content] : cases) {
    int accepted = 0;
    for (int i = 0; i < 20000; ++i) {
      try {
        const TriangleMesh damaged = parse(npfem_test::mutated(content, random), "f");
        ASSERT_NO_THROW(require_well_formed(damaged, "f"));
        ++accepted;
      } catch (const Error&) {
      }
    }
    EXPECT_LT(accepted, 19000) << content.substr(0, 10);
    EXPECT_GT(accepted, 100) << content.substr(0, 10);
  }
}

TEST(ReadMesh, GoesByTheExtension) {
  const TriangleMesh mesh = icosahedral_sphere(1);
  for (const char* extension : {".off", ".OBJ", ".stl", ".ply"}) {
    const std::string path = ::testing::TempDir() + "npfem_test_mesh" + extension;
    write_mesh(path, mesh);
    EXPECT_EQ(read_mesh(path).triangles.size(), mesh.triangles.size()) << extension;
    std::filesystem::remove(path);
  }
  EXPECT_THROW(read_mesh("mesh.vtk"), Error);
  try {
    read_mesh("/nowhere/mesh.off");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::io);
    EXPECT_STREQ(error.what(), "cannot read \"/nowhere/mesh.off\": no such file");
  }
  EXPECT_THROW(write_mesh("/nowhere/mesh.off", mesh), Error);
}

}  // namespace
}  // namespace npfem
