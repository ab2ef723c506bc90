// SPDX-License-Identifier: MPL-2.0
#pragma once

// Collision of one strip, with the force of Guo, Zheng & Shi (2002).

#include "lattice/kernel/strip_populations.h"

namespace npfem::flow::NPFEM_ISA {

// Rates of the nodes of a strip: one number for all, or a pack where some lie in a fluid of another viscosity.
template <class Number>
struct Rates {
  Number even, odd, even_force, odd_force;
};

template <class Real>
NPFEM_INLINE Rates<Real> rates_of(const RelaxationRates& rates) {
  return {static_cast<Real>(rates.even), static_cast<Real>(rates.odd), static_cast<Real>(rates.even_force),
          static_cast<Real>(rates.odd_force)};
}

template <class Real>
NPFEM_INLINE Rates<Pack<Real>> chosen(PackMask<Real> inside, const Rates<Real>& first, const Rates<Real>& second) {
  return {inside ? splat(second.even) : splat(first.even), inside ? splat(second.odd) : splat(first.odd),
          inside ? splat(second.even_force) : splat(first.even_force),
          inside ? splat(second.odd_force) : splat(first.odd_force)};
}

// c_i . v for the pair p without multiplications.
template <int p, class Real>
NPFEM_INLINE Pack<Real> along(const Vector3<Real>& v) {
  constexpr auto c = d3q19::kVelocity[2 * p + 1];
  if constexpr (c[0] == 1) {
    if constexpr (c[1] == 0 && c[2] == 0) return v.x;
    if constexpr (c[1] == 1) return v.x + v.y;
    if constexpr (c[1] == -1) return v.x - v.y;
    if constexpr (c[2] == 1) return v.x + v.z;
    if constexpr (c[2] == -1) return v.x - v.z;
  } else if constexpr (c[1] == 1) {
    if constexpr (c[2] == 0) return v.y;
    if constexpr (c[2] == 1) return v.y + v.z;
    if constexpr (c[2] == -1) return v.y - v.z;
  } else {
    return v.z;
  }
}

// What collision needs to know of a strip, beside its populations.
template <class Real>
struct StripState {
  Pack<Real> base;  // drho - 3/2 u.u
  Vector3<Real> velocity;
  Vector3<Real> force;
  Pack<Real> work;  // u . F
};

// Sums and differences of opposite populations.
template <class Real>
struct Parts {
  Pack<Real> even[9];
  Pack<Real> odd[9];
};

template <int p, class Real>
NPFEM_INLINE Pack<Real> even_equilibrium(const StripState<Real>& state) {
  constexpr Real w = static_cast<Real>(d3q19::weight(2 * p + 1));
  const Pack<Real> cu = along<p, Real>(state.velocity);
  return w * (state.base + Real(4.5) * (cu * cu));
}

// xx, yy, zz, xy, xz, yz
template <class Real>
struct Stress {
  Pack<Real> s[6] = {};
};

template <int p, class Real>
NPFEM_INLINE void add_stress(const StripState<Real>& state, const Parts<Real>& parts, Stress<Real>& stress) {
  constexpr auto c = d3q19::kVelocity[2 * p + 1];
  const Pack<Real> departure = parts.even[p] - Real(2) * even_equilibrium<p, Real>(state);
  if constexpr (c[0] != 0) stress.s[0] += departure;
  if constexpr (c[1] != 0) stress.s[1] += departure;
  if constexpr (c[2] != 0) stress.s[2] += departure;
  if constexpr (c[0] * c[1] != 0) stress.s[3] += Real(c[0] * c[1]) * departure;
  if constexpr (c[0] * c[2] != 0) stress.s[4] += Real(c[0] * c[2]) * departure;
  if constexpr (c[1] * c[2] != 0) stress.s[5] += Real(c[1] * c[2]) * departure;
}

// The part of an even half-sum that carries the stress: 9/2 w (c c - 1/3) : Pi.
template <int p, class Real>
NPFEM_INLINE Pack<Real> stress_part(const Stress<Real>& stress) {
  constexpr auto c = d3q19::kVelocity[2 * p + 1];
  constexpr Real w = static_cast<Real>(d3q19::weight(2 * p + 1));
  Pack<Real> sum = (stress.s[0] + stress.s[1] + stress.s[2]) * Real(-1.0 / 3.0);
  if constexpr (c[0] != 0) sum += stress.s[0];
  if constexpr (c[1] != 0) sum += stress.s[1];
  if constexpr (c[2] != 0) sum += stress.s[2];
  if constexpr (c[0] * c[1] != 0) sum += Real(2 * c[0] * c[1]) * stress.s[3];
  if constexpr (c[0] * c[2] != 0) sum += Real(2 * c[0] * c[2]) * stress.s[4];
  if constexpr (c[1] * c[2] != 0) sum += Real(2 * c[1] * c[2]) * stress.s[5];
  return (Real(4.5) * w) * sum;
}

// A strip during its collision.
template <class Real, class Number, bool regularised, bool masked>
struct Collider {
  const Places<Real>& places;
  const FluidStrip& strip;
  const Rates<Number>& rates;
  const StripState<Real>& state;
  const Parts<Real>& parts;
  const Stress<Real>& stress;
  PackMask<Real> fluid;

  // Relaxes one pair of opposite populations and stores it. Nodes that are not fluid keep what their places hold.
  template <int p>
  NPFEM_INLINE void relax_pair(const StripPopulations<Real>& before) const {
    constexpr Real w3 = static_cast<Real>(3.0 * d3q19::weight(2 * p + 1));
    const Pack<Real> cu = along<p, Real>(state.velocity);
    const Pack<Real> cf = along<p, Real>(state.force);
    const Pack<Real> odd = Real(0.5) * parts.odd[p];
    const Pack<Real> even_eq = even_equilibrium<p, Real>(state);
    const Pack<Real> odd_eq = w3 * cu;
    const Pack<Real> even_source = w3 * (Real(3) * (cu * cf) - state.work);
    const Pack<Real> odd_source = w3 * cf;
    Pack<Real> even_after;
    if constexpr (regularised) {
      even_after = even_eq + (Real(1) - rates.even) * stress_part<p, Real>(stress) + rates.even_force * even_source;
    } else {
      const Pack<Real> even = Real(0.5) * parts.even[p];
      even_after = even + rates.even * (even_eq - even) + rates.even_force * even_source;
    }
    const Pack<Real> odd_after = odd + rates.odd * (odd_eq - odd) + rates.odd_force * odd_source;
    Pack<Real> up = even_after + odd_after;
    Pack<Real> down = even_after - odd_after;
    if constexpr (masked) {
      up = fluid ? up : before.down[p];
      down = fluid ? down : before.up[p];
    }
    store_pair<p>(places, strip, up, down);
  }
};

template <class Real, bool node_force, bool regularised, bool masked, class Number>
NPFEM_INLINE void collide_strip(const FluidFields<Real>& fields, const Places<Real>& places, const FluidStrip& s,
                                const Rates<Number>& rates) {
  const StripPopulations<Real> f = load_populations(fields.populations, places, s);
  Parts<Real> parts;
  for (int p = 0; p < 9; ++p) {
    parts.even[p] = f.up[p] + f.down[p];
    parts.odd[p] = f.up[p] - f.down[p];
  }
  StripState<Real> state;
  if constexpr (node_force) {
    state.force = load_vectors<Real>(fields.force + std::ptrdiff_t{s.strip} * 24);
  } else {
    state.force = {splat(static_cast<Real>(fields.body_force[0])), splat(static_cast<Real>(fields.body_force[1])),
                   splat(static_cast<Real>(fields.body_force[2]))};
  }
  const Vector3<Real> j = momentum<Real>(parts.odd);
  const Vector3<Real>& force = state.force;
  const Vector3<Real> u{j.x + Real(0.5) * force.x, j.y + Real(0.5) * force.y, j.z + Real(0.5) * force.z};
  state.velocity = u;
  state.work = u.x * force.x + u.y * force.y + u.z * force.z;
  state.base = density_deviation(f.rest, parts.even) - Real(1.5) * (u.x * u.x + u.y * u.y + u.z * u.z);

  Stress<Real> stress;
  if constexpr (regularised) {
    for_each_pair([&]<int p>() NPFEM_INLINE_LAMBDA { add_stress<p>(state, parts, stress); });
  }

  const PackMask<Real> fluid = mask_of<Real>(s.fluid);
  constexpr Real w0 = static_cast<Real>(d3q19::weight(0));
  constexpr Real w03 = static_cast<Real>(3.0 * d3q19::weight(0));
  Pack<Real> rest;
  if constexpr (regularised) {
    const Pack<Real> trace = stress.s[0] + stress.s[1] + stress.s[2];
    rest = w0 * state.base - (Real(1) - rates.even) * (Real(1.5) * w0 * trace) - rates.even_force * w03 * state.work;
  } else {
    rest = f.rest + rates.even * (w0 * state.base - f.rest) - rates.even_force * w03 * state.work;
  }
  if constexpr (masked) rest = fluid ? rest : f.rest;
  pack_at(fields.populations + s.strip * kStripNumbers) = rest;

  const Collider<Real, Number, regularised, masked> collider{places, s, rates, state, parts, stress, fluid};
  for_each_pair([&]<int p>() NPFEM_INLINE_LAMBDA { collider.template relax_pair<p>(f); });
}

template <class Real, bool node_force, bool regularised, bool two_fluids>
NPFEM_INLINE void collide_strips(const FluidFields<Real>& fields, std::span<const FluidStrip> strips) {
  const Places<Real> places(fields.populations, fields.odd_step);
  const Rates<Real> first = rates_of<Real>(fields.rates[0]);
  const Rates<Real> second = rates_of<Real>(fields.rates[1]);
  const FluidStrip* const end = strips.data() + strips.size();
  for (const FluidStrip* s = strips.data(); s != end; ++s) {
    prefetch(fields, places, s);
    const bool whole = s->fluid == 0xff;
    if constexpr (two_fluids) {
      const std::uint8_t inside = fields.inside[s->strip];
      if (inside != 0) {
        const Rates<Pack<Real>> rates = chosen<Real>(mask_of<Real>(inside), first, second);
        if (whole) {
          collide_strip<Real, node_force, regularised, false>(fields, places, *s, rates);
        } else {
          collide_strip<Real, node_force, regularised, true>(fields, places, *s, rates);
        }
        continue;
      }
    }
    if (whole) {
      collide_strip<Real, node_force, regularised, false>(fields, places, *s, first);
    } else {
      collide_strip<Real, node_force, regularised, true>(fields, places, *s, first);
    }
  }
}

template <class Real, bool regularised, bool two_fluids>
NPFEM_INLINE void collide_with_force(const FluidFields<Real>& fields, std::span<const FluidStrip> strips) {
  if (fields.force != nullptr) {
    collide_strips<Real, true, regularised, two_fluids>(fields, strips);
  } else {
    collide_strips<Real, false, regularised, two_fluids>(fields, strips);
  }
}

template <class Real>
void collide(const FluidFields<Real>& fields, std::span<const FluidStrip> strips) {
  const bool two_fluids = fields.inside != nullptr;
  if (fields.regularised) {
    two_fluids ? collide_with_force<Real, true, true>(fields, strips)
               : collide_with_force<Real, true, false>(fields, strips);
  } else {
    two_fluids ? collide_with_force<Real, false, true>(fields, strips)
               : collide_with_force<Real, false, false>(fields, strips);
  }
}

}  // namespace npfem::flow::NPFEM_ISA
