// SPDX-License-Identifier: MPL-2.0
// What the steps of several cells at once share.
#pragma once

#include <cstdint>

#include "backend/cpu/kernel/pack.h"

namespace npfem::NPFEM_ISA {

/// Sum over the vertices of the scalar products, one per cell. Two running sums: a chain of dependent additions would
/// wait for each one.
template <class Shape>
typename Shape::P inner(const typename Shape::P* a, const typename Shape::P* b, int length) {
  typename Shape::P even(0), odd(0);
  int i = 0;
  for (; i + 2 <= length; i += 2) even += a[i] * b[i], odd += a[i + 1] * b[i + 1];
  if (i < length) even += a[i] * b[i];
  return Shape::sum(even + odd);
}

/// What is true of one cell: of its lane, or of all lanes where they hold the elements of a lone cell.
template <class Shape, class M>
NPFEM_LANES_INLINE void set_cell(M& lanes, int cell, bool value) {
  for (int l = 0; l < Shape::lanes; ++l) {
    if (Shape::cells == 1 || l == cell) lanes.set(l, value);
  }
}

/// The cells whose bit is set.
template <class Shape, class M>
NPFEM_LANES_INLINE M cells_of(std::uint32_t bits) {
  M lanes = M::none();
  for (int cell = 0; cell < Shape::cells; ++cell) set_cell<Shape>(lanes, cell, (bits >> cell & 1u) != 0);
  return lanes;
}

template <class T>
NPFEM_LANES_INLINE void swap_fields(T*& a, T*& b) {
  T* const c = a;
  a = b;
  b = c;
}

}  // namespace npfem::NPFEM_ISA
