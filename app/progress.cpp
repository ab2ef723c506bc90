// SPDX-License-Identifier: MPL-2.0
#include "progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace npfem::app {

Progress::Progress(bool shown, const Work& work)
    : shown_(shown), terminal_(isatty(STDERR_FILENO) == 1), work_(work), start_(Clock::now()) {}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::step_done(std::int64_t steps_done, int cells) {
  if (!shown_) return;
  const double pause = terminal_ ? 0.2 : 5.0;
  if (seconds() - last_print_ < pause) return;
  last_print_ = seconds();
  print(steps_done, cells);
}

void Progress::finish(std::int64_t steps_done, int cells) {
  if (!shown_) return;
  print(steps_done, cells);
  if (terminal_) std::fputc('\n', stderr);
}

void Progress::print(std::int64_t steps_done, int cells) {
  const auto steps = static_cast<double>(steps_done);
  const double rate = (steps - static_cast<double>(work_.first_step)) / std::fmax(seconds(), 1e-9);
  const double left = rate > 0 ? (static_cast<double>(work_.steps) - steps) / rate : 0;
  const auto whole_seconds = static_cast<long long>(std::ceil(left));
  const double percent = work_.steps > 0 ? 100 * steps / static_cast<double>(work_.steps) : 100;
  std::fprintf(stderr, "%sstep %lld/%lld  %.0f %%  %.4g steps/s  %.3g MLUPS  %.4g cell-steps/s  %lld:%02lld left%s",
               terminal_ ? "\r" : "", static_cast<long long>(steps_done), static_cast<long long>(work_.steps), percent,
               rate, rate * work_.nodes_per_step * 1e-6, rate * cells / work_.steps_per_solve, whole_seconds / 60,
               whole_seconds % 60, terminal_ ? "   " : "\n");
  std::fflush(stderr);
}

}  // namespace npfem::app
