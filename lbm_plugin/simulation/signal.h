// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

namespace npfem::flow {

/// A factor that varies periodically in time, like the beat of the heart; 1 at all times unless made otherwise.
class Signal {
 public:
  struct Point {
    double time;  ///< us
    double factor;
  };
  Signal() = default;
  /// mean + amplitude sin(2 pi t / period + phase); period in us, phase in rad.
  static Signal sine(double mean, double amplitude, double period, double phase);
  /// Straight lines between the points, whose times ascend from 0 or later to less than the period (us); the last is
  /// joined to the first of the next period.
  static Signal table(std::vector<Point> points, double period);

  bool is_constant() const { return period_ == 0; }
  double period() const { return period_; }  ///< us; 0 where it is constant
  /// At the time t >= 0, us; the same, to round-off of t, in every period.
  double at(double t) const;
  /// Largest magnitude.
  double largest() const;

 private:
  double mean_ = 1, amplitude_ = 0, phase_ = 0;
  double period_ = 0;          // us; 0: constant
  std::vector<Point> points_;  // empty: a sine
};

}  // namespace npfem::flow
