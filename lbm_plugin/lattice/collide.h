// SPDX-License-Identifier: MPL-2.0
#pragma once

// The inner loop of the fluid: collision and streaming of one row of fluid nodes in one pass over memory.

#include <array>
#include <cstddef>

#include "lattice/d3q19.h"

namespace npfem::flow {

// The populations of one node sorted into opposite pairs (2p+1, 2p+2): sums and differences, from which density,
// momentum and both relaxations follow.
struct PairedPopulations {
  double rest;
  std::array<double, 9> even;  // f_i + f_-i
  std::array<double, 9> odd;   // f_i - f_-i

  double density_deviation() const {
    return rest + (even[0] + even[1] + even[2]) + (even[3] + even[4] + even[5]) + (even[6] + even[7] + even[8]);
  }
  Vec3 momentum() const {
    return {odd[0] + (odd[3] + odd[4]) + (odd[5] + odd[6]), odd[1] + (odd[3] - odd[4]) + (odd[7] + odd[8]),
            odd[2] + (odd[5] - odd[6]) + (odd[7] - odd[8])};
  }
};

// `node` points to population 0 of the node; component i lies i * stride further on.
inline PairedPopulations load_pairs(const double* node, std::ptrdiff_t stride) {
  PairedPopulations pairs;
  pairs.rest = node[0];
#pragma GCC unroll 9
  for (std::size_t p = 0; p < 9; ++p) {
    const auto i = static_cast<std::ptrdiff_t>(2 * p + 1);
    pairs.even[p] = node[i * stride] + node[(i + 1) * stride];
    pairs.odd[p] = node[i * stride] - node[(i + 1) * stride];
  }
  return pairs;
}

struct RelaxationRates {
  double even;        // 1 / tau
  double odd;         // 1 / tau_odd, (tau - 1/2)(tau_odd - 1/2) = magic
  double even_force;  // 1 - even / 2: Guo's factor in front of the force, one for each part
  double odd_force;

  RelaxationRates(double tau, double magic)
      : even(1.0 / tau),
        odd(1.0 / (0.5 + magic / (tau - 0.5))),
        even_force(1.0 - 0.5 * even),
        odd_force(1.0 - 0.5 * odd) {}
};

// Fields over one local grid, component by component.
struct CollisionFields {
  const double* populations;
  double* next;  // receives the populations at the nodes they move to, solid and halo nodes included
  const double* force;
  std::ptrdiff_t stride;                                 // between components
  std::array<std::ptrdiff_t, d3q19::kDirections> moves;  // index of the node x + c_i less that of x
};

// Nodes first <= n < first + length, all fluid.
void collide_and_push_row(const RelaxationRates& rates, const CollisionFields& fields, std::ptrdiff_t first,
                          std::ptrdiff_t length);

}  // namespace npfem::flow
