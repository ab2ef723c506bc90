// SPDX-License-Identifier: MPL-2.0
#include "bench/bandwidth.h"

#include <algorithm>

#include "bench/clock.h"
#include "lattice/aligned_array.h"
#include "lattice/threads.h"

namespace npfem::app::bench {

double in_place_bandwidth(int threads) {
  flow::set_lattice_threads(threads);
  flow::AlignedArray<double> numbers(std::size_t{24} << 20);
  double* const x = numbers.data();
  const auto count = static_cast<std::ptrdiff_t>(numbers.size());
  double best = 0;
  for (int repeat = 0; repeat < 8; ++repeat) {
    const Stopwatch watch(Clock::wall);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i) x[i] = 0.999 * x[i] + 1e-9;
    if (repeat > 0) best = std::max(best, 2e6 * 8 * static_cast<double>(count) / watch.us());  // first: pages appear
  }
  return best;
}

}  // namespace npfem::app::bench
