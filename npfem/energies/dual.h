// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/number.h"

namespace npfem {

/// A number with its derivative along one direction: forward-mode differentiation (Griewank & Walther 2008, chapter 3).
/// An energy evaluated on duals gives, beside its gradient, one column of its exact second derivative.
struct Dual {
  double value = 0;
  double slope = 0;

  Dual() = default;
  NPFEM_HD Dual(double v) : value(v) {}  // implicit: a plain number is a constant
  NPFEM_HD Dual(double v, double s) : value(v), slope(s) {}

  NPFEM_HD Dual& operator+=(const Dual& b) { return *this = *this + b; }
  NPFEM_HD Dual& operator-=(const Dual& b) { return *this = *this - b; }
  NPFEM_HD Dual& operator*=(const Dual& b) { return *this = *this * b; }
  NPFEM_HD Dual& operator/=(const Dual& b) { return *this = *this / b; }

  NPFEM_HD friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  NPFEM_HD friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  NPFEM_HD friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  NPFEM_HD friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  NPFEM_HD friend Dual operator/(const Dual& a, const Dual& b) {
    const double ratio = a.value / b.value;
    return {ratio, (a.slope - ratio * b.slope) / b.value};
  }

  // Comparisons see the value alone: the slope is that of the side taken.
  NPFEM_HD friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  NPFEM_HD friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
};

/// The square root has no slope at zero; there the length of a vector is taken as constant.
NPFEM_HD Dual square_root(const Dual& a) {
  const double root = square_root(a.value);
  return {root, root > 0 ? 0.5 * a.slope / root : 0.0};
}

NPFEM_HD Dual select(bool condition, const Dual& yes, const Dual& no) {
  return condition ? yes : no;
}

}  // namespace npfem
