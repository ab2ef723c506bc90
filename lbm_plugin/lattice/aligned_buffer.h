// SPDX-License-Identifier: MPL-2.0
#pragma once

// Zeroed doubles on a page boundary, on huge pages where the system grants them: a lattice touches dozens of streams
// at once, more than the address translation cache holds in 4 KiB pages.

#include <cstddef>
#include <span>
#include <utility>

namespace npfem::flow {

class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t count);  // std::bad_alloc where memory is short
  AlignedBuffer(AlignedBuffer&& other) noexcept { swap(other); }
  AlignedBuffer& operator=(AlignedBuffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~AlignedBuffer();

  double* data() { return data_; }
  const double* data() const { return data_; }
  std::size_t size() const { return count_; }
  void swap(AlignedBuffer& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(count_, other.count_);
  }

 private:
  double* data_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace npfem::flow
