// SPDX-License-Identifier: MPL-2.0
#include "placement/cells_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "file.h"
#include "quantity.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

std::vector<StoredCells> two_types() {
  StoredCells rbc{"rbc", 4, 0x0123456789abcdefULL, {}};
  for (int n = 0; n < 36; ++n) rbc.positions.push_back(1.0 / 3 * n - 4);
  StoredCells other{"my count 7 cell", 3, 0xfULL, {0, -0.0, 1e-300, 1, 2, 3, 1e300, 5, 6}};
  return {rbc, other};
}

std::string error_of(const std::string& bytes) {
  try {
    parse_cells_file(bytes, "packed.cells");
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The bytes of a file with another header, its checksum made right again.
std::string with_header(const std::string& header) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : header) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  std::string bytes = header;
  for (int n = 0; n < 8; ++n) bytes += static_cast<char>((hash >> (8 * n)) & 0xff);
  return bytes;
}

TEST(CellsFile, ReadsBackTheSameBits) {
  const std::vector<StoredCells> cells = two_types();
  const std::vector<StoredCells> again = parse_cells_file(to_cells_file(cells), "memory");
  ASSERT_EQ(again.size(), 2u);
  for (std::size_t type = 0; type < 2; ++type) {
    EXPECT_EQ(again[type].name, cells[type].name);
    EXPECT_EQ(again[type].vertices, cells[type].vertices);
    EXPECT_EQ(again[type].mesh_hash, cells[type].mesh_hash);
    EXPECT_EQ(again[type].positions, cells[type].positions);
  }
  EXPECT_EQ(again[0].count(), 3);
  EXPECT_EQ(again[0].cell(2)[0], cells[0].positions[24]);
  EXPECT_TRUE(std::signbit(again[1].positions[1]));
}

TEST(CellsFile, HeaderIsTextThatAPersonCanRead) {
  const std::string bytes = to_cells_file(two_types());
  EXPECT_TRUE(
      bytes.starts_with("npfem cells 1\n"
                        "type rbc count 3 vertices 4 mesh_hash 0123456789abcdef\n"
                        "type my count 7 cell count 1 vertices 3 mesh_hash 000000000000000f\n"
                        "end\n"));
  EXPECT_TRUE(parse_cells_file(to_cells_file({}), "memory").empty());
}

TEST(CellsFile, EveryChangedByteAndEveryTruncationIsRefused) {
  const std::string bytes = to_cells_file(two_types());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::string changed = bytes;
    changed[n] = static_cast<char>(changed[n] ^ 1);
    EXPECT_NE(error_of(changed), "no error") << "byte " << n;
    EXPECT_NE(error_of(bytes.substr(0, n)), "no error") << "length " << n;
  }
  EXPECT_EQ(error_of(bytes.substr(0, bytes.size() - 1)),
            "\"packed.cells\" is damaged: its checksum does not fit its content; it was cut short or changed");
  EXPECT_EQ(error_of("x"), "\"packed.cells\" is not a cells file: its first line is not \"npfem cells 1\"");
}

TEST(CellsFile, HeadersThatMakeNoSenseAreRefused) {
  EXPECT_EQ(error_of(with_header("npfem cells 1\ntype a count 1 vertices 2 mesh_hash 0\nend\n")),
            "\"packed.cells\" holds 0 bytes of positions where its header needs 48");
  EXPECT_EQ(error_of(with_header("npfem cells 1\ntype a count 1 vertices 2 mesh_hash 0\n")),
            "\"packed.cells\" has no line \"end\" after its types");
  for (const char* line : {"type a count 1 vertices 0 mesh_hash 0", "type a count -1 vertices 2 mesh_hash 0",
                           "type a count 1 vertices 2 mesh_hash xyz", "type a vertices 2 mesh_hash 0", "typo",
                           "type a count 99999999999999999999 vertices 2 mesh_hash 0"}) {
    EXPECT_EQ(
        error_of(with_header("npfem cells 1\n" + std::string(line) + "\nend\n")).find("\"packed.cells\" has the "), 0u)
        << line;
  }
  std::vector<StoredCells> cells = two_types();
  cells[0].positions[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(to_cells_file(cells)),
            "\"packed.cells\" holds a position that is not a finite number, among the cells rbc");
}

TEST(CellsFile, OnDisk) {
  const ScratchFolder folder("cells_file");
  const std::string path = (folder.path() / "packed.cells").string();
  write_cells_file(path, two_types());
  EXPECT_EQ(read_cells_file(path)[1].positions, two_types()[1].positions);
  EXPECT_THROW(read_cells_file(path + "x"), text::FileError);
  EXPECT_THROW(write_cells_file((folder.path() / "no/such/folder").string(), two_types()), text::FileError);
}

TEST(CellsFile, MeshHashKnowsTheTrianglesAndTheirOrder) {
  const std::vector<std::int32_t> one{0, 1, 2, 2, 1, 3}, other{0, 1, 2, 1, 2, 3};
  EXPECT_EQ(hash_of_mesh(one), hash_of_mesh(one));
  EXPECT_NE(hash_of_mesh(one), hash_of_mesh(other));
  EXPECT_EQ(hash_of_mesh({}), 0xcbf29ce484222325ULL);
}

}  // namespace
}  // namespace npfem::flow
