// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <ctime>

namespace npfem::app::bench {

/// One thread is timed by the processor time of the process, which other programs on the machine hardly disturb;
/// several threads by the wall clock, because some of them may wait.
enum class Clock { cpu, wall };

inline Clock clock_for(int threads) {
  return threads == 1 ? Clock::cpu : Clock::wall;
}
inline const char* name_of(Clock clock) {
  return clock == Clock::cpu ? "cpu" : "wall";
}

class Stopwatch {
 public:
  explicit Stopwatch(Clock clock) : clock_(clock), start_(now()) {}
  double us() const { return now() - start_; }

 private:
  double now() const {
    timespec t{};
    clock_gettime(clock_ == Clock::cpu ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
  }

  Clock clock_;
  double start_;
};

}  // namespace npfem::app::bench
