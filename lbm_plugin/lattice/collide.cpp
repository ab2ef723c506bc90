// SPDX-License-Identifier: MPL-2.0
#include "lattice/collide.h"

#include <utility>

namespace npfem::flow {
namespace {

// c_i . v without multiplications.
template <std::size_t i>
[[gnu::always_inline]] inline double along(const Vec3& v) {
  constexpr auto c = d3q19::kVelocity[i];
  constexpr std::size_t first = c[0] != 0 ? 0 : (c[1] != 0 ? 1 : 2);
  constexpr std::size_t last = c[2] != 0 ? 2 : (c[1] != 0 ? 1 : 0);
  static_assert(c[first] == 1, "pairs begin with the direction whose first component is positive");
  if constexpr (first == last) return v[first];
  if constexpr (c[last] > 0) return v[first] + v[last];
  return v[first] - v[last];
}

// What collision needs to know of a node, beside its populations.
struct NodeState {
  double base;  // drho - 3/2 u.u
  Vec3 velocity;
  Vec3 force;
  double work;  // u . F
};

// Relaxes one pair of opposite populations and stores it at the two nodes it moves to.
template <std::size_t p>
[[gnu::always_inline]] inline void push_pair(const RelaxationRates& rates, const CollisionFields& fields,
                                             const NodeState& node, const PairedPopulations& pairs, std::ptrdiff_t n) {
  constexpr std::size_t i = 2 * p + 1;
  constexpr double w = d3q19::weight(static_cast<int>(i));
  const double cu = along<i>(node.velocity);
  const double cf = along<i>(node.force);
  const double even = 0.5 * pairs.even[p];
  const double odd = 0.5 * pairs.odd[p];
  const double even_equilibrium = w * (node.base + 4.5 * (cu * cu));
  const double odd_equilibrium = (3.0 * w) * cu;
  const double even_source = (3.0 * w) * (3.0 * (cu * cf) - node.work);
  const double odd_source = (3.0 * w) * cf;
  const double even_after = even + rates.even * (even_equilibrium - even) + rates.even_force * even_source;
  const double odd_after = odd + rates.odd * (odd_equilibrium - odd) + rates.odd_force * odd_source;
  double* const next = fields.next + n;
  next[static_cast<std::ptrdiff_t>(i) * fields.stride + fields.moves[i]] = even_after + odd_after;
  next[static_cast<std::ptrdiff_t>(i + 1) * fields.stride + fields.moves[i + 1]] = even_after - odd_after;
}

template <std::size_t... p>
[[gnu::always_inline]] inline void collide_and_push_node(const RelaxationRates& rates, const CollisionFields& fields,
                                                         std::ptrdiff_t n, std::index_sequence<p...>) {
  const PairedPopulations pairs = load_pairs(fields.populations + n, fields.stride);
  const double* force = fields.force + n;
  NodeState node;
  node.force = {force[0], force[fields.stride], force[2 * fields.stride]};
  const Vec3 j = pairs.momentum();
  const Vec3& f = node.force;
  const Vec3 u{j[0] + 0.5 * f[0], j[1] + 0.5 * f[1], j[2] + 0.5 * f[2]};
  node.velocity = u;
  node.work = u[0] * f[0] + u[1] * f[1] + u[2] * f[2];
  node.base = pairs.density_deviation() - 1.5 * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);

  constexpr double w0 = d3q19::weight(0);
  fields.next[n] = pairs.rest + rates.even * (w0 * node.base - pairs.rest) - rates.even_force * (3.0 * w0) * node.work;
  (push_pair<p>(rates, fields, node, pairs, n), ...);
}

}  // namespace

void collide_and_push_row(const RelaxationRates& rates, const CollisionFields& fields, std::ptrdiff_t first,
                          std::ptrdiff_t length) {
  const RelaxationRates local_rates = rates;  // copies the compiler knows nobody else writes to
  const CollisionFields local_fields = fields;
#pragma omp simd
  for (std::ptrdiff_t n = first; n < first + length; ++n) {
    collide_and_push_node(local_rates, local_fields, n, std::make_index_sequence<9>{});
  }
}

}  // namespace npfem::flow
