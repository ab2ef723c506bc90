// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cmath>

#include "energies/host_device.h"

namespace npfem {

// What an energy asks of its number type T besides + - * /. A pack of SIMD lanes offers the same functions, which is
// why energies choose with select() and never with `if`: every lane may take another side.

NPFEM_HD double square_root(double a) {
  return ::sqrt(a);
}
NPFEM_HD float square_root(float a) {
  return ::sqrtf(a);
}

NPFEM_HD double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}
NPFEM_HD float select(bool condition, float yes, float no) {
  return condition ? yes : no;
}

template <class T>
NPFEM_HD T larger(const T& a, const T& b) {
  return select(a < b, b, a);
}

template <class T>
NPFEM_HD T smaller(const T& a, const T& b) {
  return select(a < b, a, b);
}

template <class T>
NPFEM_HD T absolute(const T& a) {
  return select(a < T(0), -a, a);
}

/// On a bound the bound is returned, so that a derivative sees a constant there: with least = largest it never sees
/// `a`.
template <class T>
NPFEM_HD T clamp(const T& a, const T& least, const T& largest) {
  const T below = smaller(a, largest);
  return select(least < below, below, least);
}

}  // namespace npfem
