// SPDX-License-Identifier: MPL-2.0
#pragma once

// Zeroed numbers on a page boundary, on huge pages where the system grants them: a lattice touches more memory at once
// than the address translation cache holds in pages of 4 KiB. Pages nobody touches cost nothing.

#include <cstddef>
#include <utility>

namespace npfem::flow {

// Zeroed memory; std::bad_alloc where it is short.
void* allocate_pages(std::size_t bytes);
void free_pages(void* pages, std::size_t bytes);

template <class Number>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count)
      : data_(static_cast<Number*>(allocate_pages(count * sizeof(Number)))), count_(count) {}
  AlignedArray(AlignedArray&& other) noexcept { swap(other); }
  AlignedArray& operator=(AlignedArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~AlignedArray() { free_pages(data_, count_ * sizeof(Number)); }

  Number* data() { return data_; }
  const Number* data() const { return data_; }
  std::size_t size() const { return count_; }
  void swap(AlignedArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(count_, other.count_);
  }

 private:
  Number* data_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace npfem::flow
