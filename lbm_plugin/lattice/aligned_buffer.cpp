// SPDX-License-Identifier: MPL-2.0
#include "lattice/aligned_buffer.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace npfem::flow {
namespace {

constexpr std::size_t kSmallPage = std::size_t{4} << 10;
constexpr std::size_t kHugePage = std::size_t{2} << 20;

}  // namespace

AlignedBuffer::AlignedBuffer(std::size_t count) : count_(count) {
  if (count == 0) return;
  const std::size_t page = count * sizeof(double) >= kHugePage ? kHugePage : kSmallPage;
  const std::size_t bytes = (count * sizeof(double) + page - 1) / page * page;
  data_ = static_cast<double*>(std::aligned_alloc(page, bytes));
  if (data_ == nullptr) throw std::bad_alloc();
  if (page == kHugePage) madvise(data_, bytes, MADV_HUGEPAGE);  // a wish: refusal costs speed only
  std::fill_n(data_, count, 0.0);
}

AlignedBuffer::~AlignedBuffer() {
  std::free(data_);
}

}  // namespace npfem::flow
