// SPDX-License-Identifier: MPL-2.0
#pragma once

// Fetching the populations of a strip from where the last step has left them, and storing them where the next one looks
// (see lattice/kernels.h).

#include <utility>

#include "lattice/kernel/strip_pack.h"
#include "lattice/kernels.h"

namespace npfem::flow::NPFEM_ISA {

// Populations of a strip by pairs of opposite directions.
template <class Real>
struct StripPopulations {
  Pack<Real> rest;
  Pack<Real> up[9];    // f_i, i = 2 p + 1
  Pack<Real> down[9];  // f_i+1
};

// Strip that holds x + c_i for the pair p, or its node before where c_i leads to the next node along x.
template <int p>
NPFEM_INLINE std::ptrdiff_t far_strip(const FluidStrip& s) {
  constexpr int y = d3q19::kVelocity[2 * p + 1][1];
  constexpr int z = d3q19::kVelocity[2 * p + 1][2];
  if constexpr (y == 0 && z == 0) return s.strip;
  if constexpr (y == 1 && z == 0) return s.y_up;
  if constexpr (y == -1 && z == 0) return s.y_down;
  if constexpr (y == 0 && z == 1) return s.z_up;
  if constexpr (y == 0 && z == -1) return s.z_down;
  if constexpr (y == 1 && z == 1) return s.yz_up;
  if constexpr (y == 1 && z == -1) return s.y_up_z_down;
}
template <int p>
inline constexpr bool leads_along_x = d3q19::kVelocity[2 * p + 1][0] == 1;

// work.operator()<p>() for the nine pairs of opposite directions.
template <class Work, int... p>
NPFEM_INLINE void for_pairs(const Work& work, std::integer_sequence<int, p...>) {
  (work.template operator()<p>(), ...);
}
template <class Work>
NPFEM_INLINE void for_each_pair(const Work& work) {
  for_pairs(work, std::make_integer_sequence<int, 9>{});
}

// The two places of a pair change roles from step to step.
template <class Real>
struct Places {
  Real* near;
  Real* far;
  NPFEM_INLINE Places(Real* populations, bool odd_step)
      : near(populations + (odd_step ? 0 : 8)), far(populations + (odd_step ? 8 : 0)) {}
  template <int p>
  NPFEM_INLINE Real* near_of(const FluidStrip& s) const {
    return near + s.strip * kStripNumbers + 8 * (2 * p + 1);
  }
  template <int p>
  NPFEM_INLINE Real* far_of(const FluidStrip& s) const {
    return far + far_strip<p>(s) * kStripNumbers + 8 * (2 * p + 1);
  }
};

template <int p, class Real>
NPFEM_INLINE void load_pair(const Places<Real>& places, const FluidStrip& s, StripPopulations<Real>& f) {
  f.up[p] = pack_at(places.template near_of<p>(s));
  const Real* far = places.template far_of<p>(s);
  if constexpr (leads_along_x<p>) {
    f.down[p] = from_next_node(pack_at(far), pack_at(far + kStripNumbers));
  } else {
    f.down[p] = pack_at(far);
  }
}

// Stores populations after collision: f_i with the neighbour, f_i+1 here.
template <int p, class Real>
NPFEM_INLINE void store_pair(const Places<Real>& places, const FluidStrip& s, Pack<Real> up, Pack<Real> down) {
  pack_at(places.template near_of<p>(s)) = down;
  Real* far = places.template far_of<p>(s);
  if constexpr (leads_along_x<p>) {
    pack_at(far) = to_next_node(pack_at(far), up);
    pack_at(far + kStripNumbers) = to_following_strip(pack_at(far + kStripNumbers), up);
  } else {
    pack_at(far) = up;
  }
}

template <class Real>
NPFEM_INLINE StripPopulations<Real> load_populations(Real* populations, const Places<Real>& places,
                                                     const FluidStrip& s) {
  StripPopulations<Real> f;
  f.rest = pack_at(populations + s.strip * kStripNumbers);
  for_each_pair([&]<int p>() NPFEM_INLINE_LAMBDA { load_pair<p>(places, s, f); });
  return f;
}

// The places that a strip touches are scattered over seven rows: the processor does not guess them. They are asked for
// kStripsAhead strips ahead, those of the next rows too. Before that, whole strips are asked for in the order of
// memory, at the time when the plane two below is updated: the rows are visited in an order (NodeMap) that keeps the
// planes in between in the second-level cache.
template <int p, class Real>
NPFEM_INLINE void prefetch_pair(const Places<Real>& places, const FluidStrip& s) {
  __builtin_prefetch(places.template near_of<p>(s), 1, 3);
  __builtin_prefetch(places.template far_of<p>(s) + (leads_along_x<p> ? kStripNumbers : 0), 1, 3);
}
template <class Real>
NPFEM_INLINE void prefetch_strip(const FluidFields<Real>& fields, const Places<Real>& places, const FluidStrip& s) {
  __builtin_prefetch(fields.populations + s.strip * kStripNumbers, 1, 3);
  for_each_pair([&]<int p>() NPFEM_INLINE_LAMBDA { prefetch_pair<p>(places, s); });
}

template <class Real>
NPFEM_INLINE void prefetch_plane_above(const FluidFields<Real>& fields, const FluidStrip& s) {
  constexpr std::ptrdiff_t line = 64 / sizeof(Real);
  const Real* const strip = fields.populations + (std::ptrdiff_t{2} * s.z_up - s.strip) * kStripNumbers;
#pragma GCC unroll 19
  for (std::ptrdiff_t n = 0; n < kStripNumbers; n += line) __builtin_prefetch(strip + n, 1, 2);
}

template <class Real>
NPFEM_INLINE void prefetch(const FluidFields<Real>& fields, const Places<Real>& places, const FluidStrip* s) {
  prefetch_plane_above(fields, *s);
  prefetch_strip(fields, places, s[NodeMap::kStripsAhead]);
}

// Deviation of the density from 1, and momentum, from sums and differences of opposite populations.
template <class P>
NPFEM_INLINE P density_deviation(P rest, const P* even) {
  return rest + (even[0] + even[1] + even[2]) + (even[3] + even[4] + even[5]) + (even[6] + even[7] + even[8]);
}
template <class Real>
NPFEM_INLINE Vector3<Real> momentum(const Pack<Real>* odd) {
  return {odd[0] + (odd[3] + odd[4]) + (odd[5] + odd[6]), odd[1] + (odd[3] - odd[4]) + (odd[7] + odd[8]),
          odd[2] + (odd[5] - odd[6]) + (odd[7] - odd[8])};
}

}  // namespace npfem::flow::NPFEM_ISA
