// SPDX-License-Identifier: MPL-2.0
#include "lattice/aligned_array.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace npfem::flow {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

std::size_t rounded_up(std::size_t bytes) {
  return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

}  // namespace

void* allocate_pages(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  // The system gives whole pages of 4 KiB, zeroed when first touched; asked for one huge page more than needed, they
  // hold an aligned stretch, and what lies around it is given back.
  const std::size_t wanted = rounded_up(bytes);
  void* mapped = mmap(nullptr, wanted + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(mapped);
  const std::size_t skipped = (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
  char* const aligned = begin + skipped;
  if (skipped > 0) munmap(begin, skipped);
  if (skipped < kHugePage) munmap(aligned + wanted, kHugePage - skipped);
  madvise(aligned, wanted, MADV_HUGEPAGE);  // a wish: refusal costs speed only
  return aligned;
}

void free_pages(void* pages, std::size_t bytes) {
  if (pages != nullptr) munmap(pages, rounded_up(bytes));
}

}  // namespace npfem::flow
