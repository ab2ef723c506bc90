// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/number.h"

namespace npfem {

/// A number that knows how many floating-point operations have been done: each addition, multiplication, division and
/// root adds one to a counter that the number carries with it; comparisons, choices and changes of sign add none. A
/// plain number is a constant, and what combines constants alone is no operation: all cells share it.
class Counted {
 public:
  Counted() = default;
  NPFEM_HD Counted(double value) : value_(value) {}  // implicit: a constant
  NPFEM_HD Counted(double value, long& counter) : value_(value), counter_(&counter) {}

  NPFEM_HD friend Counted operator-(const Counted& a) { return {-a.value_, a.counter_}; }
  NPFEM_HD friend Counted operator+(const Counted& a, const Counted& b) { return done(a.value_ + b.value_, a, b); }
  NPFEM_HD friend Counted operator-(const Counted& a, const Counted& b) { return done(a.value_ - b.value_, a, b); }
  NPFEM_HD friend Counted operator*(const Counted& a, const Counted& b) { return done(a.value_ * b.value_, a, b); }
  NPFEM_HD friend Counted operator/(const Counted& a, const Counted& b) { return done(a.value_ / b.value_, a, b); }
  NPFEM_HD friend bool operator<(const Counted& a, const Counted& b) { return a.value_ < b.value_; }
  NPFEM_HD friend bool operator>(const Counted& a, const Counted& b) { return a.value_ > b.value_; }

  NPFEM_HD friend Counted square_root(const Counted& a) { return done(npfem::square_root(a.value_), a, a); }
  /// Counts on whichever side is taken: the lanes of a pack compute both.
  NPFEM_HD friend Counted select(bool condition, const Counted& yes, const Counted& no) {
    return {condition ? yes.value_ : no.value_, yes.counter_ ? yes.counter_ : no.counter_};
  }

 private:
  NPFEM_HD Counted(double value, long* counter) : value_(value), counter_(counter) {}
  NPFEM_HD static Counted done(double value, const Counted& a, const Counted& b) {
    long* const counter = a.counter_ ? a.counter_ : b.counter_;
    if (counter) ++*counter;
    return {value, counter};
  }

  double value_ = 0;
  long* counter_ = nullptr;
};

}  // namespace npfem
