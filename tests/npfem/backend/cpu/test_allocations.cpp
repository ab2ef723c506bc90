// SPDX-License-Identifier: MPL-2.0
// A step of the back end "cpu" takes no memory for each cell: what a call takes is for the call.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "cpu_cells.h"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t bytes, std::size_t alignment) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  if (void* const memory = std::aligned_alloc(alignment, whole > 0 ? whole : alignment)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) {
  return counted(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return counted(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace npfem {
namespace {

/// For the tables of kinds, patches and settings that a call makes.
constexpr long per_call = 24;

/// Allocations of one call of step(1) after some to warm up.
long allocations_of_a_step(Batch& batch) {
  for (int s = 0; s < 3; ++s) EXPECT_EQ(batch.step(1), 0);
  const long before = allocations.load();
  EXPECT_EQ(batch.step(1), 0);
  return allocations.load() - before;
}

TEST(Allocations, OfAStepDoNotGrowWithTheCells) {
  const auto model = testing::cell_of("rbc");
  for (const testing::CpuSetting& setting : testing::cpu_settings()) {
    for (const int integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
      long few = 0;
      for (const int cells : {1, 8, 40, 200}) {
        Batch batch(model, setting.back_end(), cells);
        setting.apply(batch.options());
        batch.options().integrator = integrator;
        batch.options().newton_iterations = 0;  // the kernels alone
        for (int c = 0; c < cells; ++c) testing::set_in_motion(batch, c, 3, 0.002);
        const long found = allocations_of_a_step(batch);
        if (cells == 1) few = found;
        EXPECT_LE(found, per_call) << setting.name() << ", " << cells << " cells, integrator " << integrator;
        EXPECT_LE(found, few + 2) << setting.name() << ", " << cells << " cells, integrator " << integrator;
      }
    }
  }
}

}  // namespace
}  // namespace npfem
