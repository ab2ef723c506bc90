// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/cpu/aligned.h"

namespace npfem::cpu {

/// The fields of all cells, blocks of `lanes` cells at a time: number i of the cell in lane l of block b is at
/// [(b * rows + i) * lanes + l] (array of structures of arrays), so that W neighbouring cells fill a SIMD register.
/// Lanes of the last block that hold no cell hold the initial shape at rest. Vertices are in the kernels' order.
/// A field that is zero in all cells takes no memory.
class StateBlocks {
 public:
  /// `order[k]`: the model's vertex that the kernels know as k; `initial`: xyz of the model's vertices.
  StateBlocks(std::vector<int> order, std::span<const Point> initial, int lanes);

  int num_cells() const { return num_cells_; }
  int num_blocks() const { return (num_cells_ + lanes_ - 1) / lanes_; }
  int lanes() const { return lanes_; }
  std::span<const int> order() const { return order_; }

  void resize(int cells);
  /// Overwrites one cell by another.
  void copy(int from, int to);
  /// Overwrites a cell by one of another set of the same model.
  void copy_from(const StateBlocks& other, int from, int to);
  /// Makes the cell a new one.
  void reset(int cell);

  void write(Field field, int cell, std::span<const double> values);
  void read(Field field, int cell, std::span<double> values) const;

  bool is_zero(Field field, int cell) const;

  /// A block of a field; null while the field is zero everywhere.
  double* block(Field field, int block);
  /// Gives the field memory, so that a kernel may write it.
  void require(Field field);
  bool has(Field field) const { return !fields_[static_cast<std::size_t>(field)].empty(); }

 private:
  std::size_t rows(Field field) const { return static_cast<std::size_t>(components(field)) * order_.size(); }
  void reset(Field field, int cell);
  std::size_t at(Field field, int cell, std::size_t row) const;
  AlignedVector<double>& grown(Field field);

  std::vector<int> order_;
  std::vector<Point> initial_;  // in the kernels' order
  int lanes_, num_cells_ = 0;
  std::size_t allocated_blocks_ = 0;
  std::array<AlignedVector<double>, num_fields> fields_;
};

}  // namespace npfem::cpu
