// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace npfem::app {

/// How a run gets on, on the error stream: one line that rewrites itself on a terminal, a new line every few seconds
/// elsewhere.
class Progress {
 public:
  struct Work {
    std::int64_t steps;           ///< of the whole run
    double nodes_per_step;        ///< fluid nodes
    int steps_per_solve;          ///< fluid steps per step of the cell solver
    std::int64_t first_step = 0;  ///< from which the run is resumed
  };
  Progress(bool shown, const Work& work);

  /// `cells`: of the whole system, now.
  void step_done(std::int64_t steps_done, int cells);
  void finish(std::int64_t steps_done, int cells);
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  void print(std::int64_t steps_done, int cells);

  bool shown_;
  bool terminal_;
  Work work_;
  Clock::time_point start_;
  double last_print_ = 0;
};

}  // namespace npfem::app
