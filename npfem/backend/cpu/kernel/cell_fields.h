// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/pack.h"
#include "backend/cpu/step_task.h"

namespace npfem::NPFEM_ISA {

/// Reads and writes the cells of a step: numbers of the state (double, one block of cells) to numbers of the kernels.
/// Number i of cell l is at [i * Shape::cells + l] of a kernel field. Positions are taken about the cell's centre, so
/// that they keep their digits in single precision.
template <class Shape, class R>
class CellFields {
 public:
  static constexpr int cells = Shape::cells;

  /// `centred` false: positions stay about the origin, because the cell's energies feel where it is.
  CellFields(const cpu::CellBlock& block, int first_lane, int num_vertices, bool centred)
      : block_(block), first_(first_lane), n_(num_vertices) {
    for (int l = 0; l < cells; ++l) {
      for (int c = 0; c < 3; ++c) centre[c][l] = 0;
    }
    for (int i = 0; i < n_ && centred; ++i) {
      for (int c = 0; c < 3; ++c) {
        const double* const row = from(block_.position, 3 * i + c);
        for (int l = 0; l < cells; ++l) centre[c][l] += row[l];
      }
    }
    for (int l = 0; l < cells; ++l) {
      for (int c = 0; c < 3; ++c) centre[c][l] /= n_;
    }
  }

  /// Row i of a field of the state: one number per cell.
  template <class Number>
  NPFEM_LANES_INLINE Number* from(Number* field, int i) const {
    return field + static_cast<std::ptrdiff_t>(i) * block_.stride + first_;
  }
  NPFEM_LANES_INLINE static R* row(void* field, int i) { return static_cast<R*>(field) + i * cells; }
  NPFEM_LANES_INLINE static const R* row(const void* field, int i) { return static_cast<const R*>(field) + i * cells; }

  const cpu::CellBlock& block() const { return block_; }

  double centre[3][cells];

 private:
  const cpu::CellBlock& block_;
  int first_, n_;
};

}  // namespace npfem::NPFEM_ISA
