// SPDX-License-Identifier: MPL-2.0
#include "simulation/signal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace npfem::flow {

Signal Signal::sine(double mean, double amplitude, double period, double phase) {
  Signal signal;
  signal.mean_ = mean;
  signal.amplitude_ = amplitude;
  signal.period_ = period;
  signal.phase_ = phase;
  return signal;
}

Signal Signal::table(std::vector<Point> points, double period) {
  Signal signal;
  signal.points_ = std::move(points);
  signal.period_ = period;
  return signal;
}

double Signal::at(double t) const {
  if (is_constant()) return 1;
  const double in_period = std::fmod(t, period_);  // exact
  if (points_.empty()) {
    return mean_ + amplitude_ * std::sin(2 * std::numbers::pi * (in_period / period_) + phase_);
  }
  const auto next = std::upper_bound(points_.begin(), points_.end(), in_period,
                                     [](double time, const Point& point) { return time < point.time; });
  Point before = next == points_.begin() ? points_.back() : *(next - 1);
  Point after = next == points_.end() ? points_.front() : *next;
  if (next == points_.begin()) before.time -= period_;
  if (next == points_.end()) after.time += period_;
  const double share = (in_period - before.time) / (after.time - before.time);
  return before.factor + share * (after.factor - before.factor);
}

double Signal::largest() const {
  if (is_constant()) return 1;
  double largest = std::abs(mean_) + std::abs(amplitude_);
  if (!points_.empty()) largest = 0;
  for (const Point& point : points_) largest = std::max(largest, std::abs(point.factor));
  return largest;
}

}  // namespace npfem::flow
