// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cmath>

namespace npfem::flow {

/// The regularised delta functions of the immersed boundary method, one dimension, lattice units. The weights of the
/// nodes around a vertex sum to 1, so that spreading keeps the total force; for every kernel their first moment about
/// the vertex is 0, so that it keeps the torque and interpolation is exact for a linear flow.
///
/// `offset` is the distance of the vertex from the anchor of the support: from the second of four nodes or the first of
/// two (0 <= offset < 1), from the middle one of three (-1/2 <= offset < 1/2).
template <int Points>
struct Kernel;

/// Linear interpolation (hat function).
template <>
struct Kernel<2> {
  [[gnu::always_inline]] static std::array<double, 2> weights(double offset) { return {1.0 - offset, offset}; }
};

/// Roma, Peskin & Berger, J. Comput. Phys. 153 (1999) 509: the squares of the weights sum to 1/2 wherever the vertex
/// is.
///   phi(r) = (1 + sqrt(1 - 3 r^2)) / 3,                       |r| <= 1/2
///          = (5 - 3|r| - sqrt(1 - 3 (1 - |r|)^2)) / 6,  1/2 <= |r| <= 3/2
template <>
struct Kernel<3> {
  [[gnu::always_inline]] static std::array<double, 3> weights(double offset) {
    const double root = std::sqrt(1.0 - 3.0 * offset * offset);
    return {(2.0 - 3.0 * offset - root) / 6.0, (1.0 + root) / 3.0, (2.0 + 3.0 * offset - root) / 6.0};
  }
};

/// Peskin, Acta Numerica 11 (2002) 479, eq. 6.27: even and odd nodes weigh the same and the squares of the weights sum
/// to 3/8 wherever the vertex is. The square root is the same for all four nodes.
///   phi(r) = (3 - 2|r| + sqrt(1 + 4|r| - 4 r^2)) / 8,        |r| <= 1
///          = (5 - 2|r| - sqrt(-7 + 12|r| - 4 r^2)) / 8,  1 <= |r| <= 2
template <>
struct Kernel<4> {
  [[gnu::always_inline]] static std::array<double, 4> weights(double offset) {
    const double root = std::sqrt(1.0 + 4.0 * offset - 4.0 * offset * offset);
    const double low = 3.0 - 2.0 * offset;
    const double high = 1.0 + 2.0 * offset;
    return {(low - root) / 8.0, (low + root) / 8.0, (high + root) / 8.0, (high - root) / 8.0};
  }
};

}  // namespace npfem::flow
