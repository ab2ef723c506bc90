// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>

#include "backend/cpu/kernel/isa.h"

namespace npfem::NPFEM_ISA {

/// Takes memory for fields one after the other from one block; each starts on a cache line.
class Carver {
 public:
  explicit Carver(void* memory) : next_(static_cast<char*>(memory)) {}
  template <class T>
  T* take(int count) {
    T* const taken = reinterpret_cast<T*>(next_);
    next_ += (static_cast<std::size_t>(count) * sizeof(T) + 63) / 64 * 64;
    return taken;
  }

 private:
  char* next_;
};

}  // namespace npfem::NPFEM_ISA
