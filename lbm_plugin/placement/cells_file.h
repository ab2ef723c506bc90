// SPDX-License-Identifier: MPL-2.0
// Cells as they stand, deformed, in one file: what packing leaves behind and a run starts from.
//
//   npfem cells 1
//   type rbc count 476 vertices 258 mesh_hash 0123456789abcdef
//   type platelet count 95 vertices 66 mesh_hash fedcba9876543210
//   end
//
// Then, binary: x y z (um, little-endian doubles) of every vertex, cell after cell in the order of the types, and
// eight bytes, little-endian: the 64-bit FNV-1a hash of everything before them. Positions are unwrapped: a cell is
// whole also where it crosses a periodic face.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace npfem::flow {

/// The cells of one type.
struct StoredCells {
  std::string name;
  int vertices = 0;               ///< of one cell
  std::uint64_t mesh_hash = 0;    ///< of its triangles: positions mean nothing on another mesh
  std::vector<double> positions;  ///< xyz of every vertex, cell after cell, um

  int count() const { return vertices > 0 ? static_cast<int>(positions.size() / (3u * unsigned(vertices))) : 0; }
  std::span<const double> cell(int n) const {
    const std::size_t numbers = 3u * static_cast<std::size_t>(vertices);
    return std::span(positions).subspan(static_cast<std::size_t>(n) * numbers, numbers);
  }
};

/// Hash of which vertices each triangle joins (FNV-1a over little-endian 32-bit ids).
std::uint64_t hash_of_mesh(std::span<const std::int32_t> triangles);

/// The whole file as bytes.
std::string to_cells_file(std::span<const StoredCells> types);
/// From such bytes; `name` stands for the file in messages. text::InputError where they are not a whole cells file.
std::vector<StoredCells> parse_cells_file(std::string_view bytes, const std::string& name);

/// text::FileError where the file cannot be written; nothing half-written is left behind.
void write_cells_file(const std::string& path, std::span<const StoredCells> types);
std::vector<StoredCells> read_cells_file(const std::string& path);

}  // namespace npfem::flow
