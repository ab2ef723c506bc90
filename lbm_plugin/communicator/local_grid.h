// SPDX-License-Identifier: MPL-2.0
#pragma once

// How one rank stores fields on its nodes: its own box and a halo of copies around it, x fastest. Local indices count
// from the first own node: own nodes are 0 <= i < size, halo nodes -halo <= i < 0 and size <= i < size + halo.
// A field of several components stores them one after the other, component_stride() apart.

#include <cstddef>

#include "communicator/decomposition.h"

namespace npfem::flow {

class LocalGrid {
 public:
  LocalGrid(const Box& own, int halo)
      : own_(own), halo_(halo), row_(own.size(0) + 2 * halo), plane_(row_ * (own.size(1) + 2 * halo)) {
    origin_ = halo * (1 + row_ + plane_);
  }

  const Box& own() const { return own_; }  // in global indices
  int size(int axis) const { return own_.size(axis); }
  int halo() const { return halo_; }

  std::ptrdiff_t index(int ix, int iy, int iz) const { return origin_ + ix + iy * row_ + iz * plane_; }
  std::ptrdiff_t offset(const Index3& step) const { return step[0] + step[1] * row_ + step[2] * plane_; }
  std::ptrdiff_t row() const { return row_; }                                   // distance of neighbours in y
  std::ptrdiff_t plane() const { return plane_; }                               // distance of neighbours in z
  std::ptrdiff_t nodes() const { return plane_ * (own_.size(2) + 2 * halo_); }  // halo included

  // At least nodes(), and equal to 24 doubles (3 cache lines) modulo 4 KiB: the same node of 19 components then falls
  // into different sets of the first-level cache, whatever the size of the box.
  std::ptrdiff_t component_stride() const { return (nodes() + 511) / 512 * 512 + 24; }

 private:
  Box own_;
  int halo_;
  std::ptrdiff_t row_;
  std::ptrdiff_t plane_;
  std::ptrdiff_t origin_ = 0;
};

}  // namespace npfem::flow
