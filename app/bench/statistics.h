// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "bench/clock.h"

namespace npfem::app::bench {

/// Median of the wall time of several calls, after one that does not count.
template <class Work>
double median_us(int repeats, Work work) {
  work();
  std::vector<double> times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Stopwatch watch(Clock::wall);
    work();
    times.push_back(watch.us());
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[static_cast<std::size_t>(repeats / 2)];
}

}  // namespace npfem::app::bench
