// SPDX-License-Identifier: MPL-2.0
#pragma once

// Velocity u = j + F/2 of the nodes of a strip.

#include "lattice/kernel/strip_populations.h"

namespace npfem::flow::NPFEM_ISA {

template <class Real>
NPFEM_INLINE void find_strip_velocity(const FluidFields<Real>& fields, const Places<Real>& places,
                                      const FluidStrip& s) {
  const StripPopulations<Real> f = load_populations(fields.populations, places, s);
  Pack<Real> odd[9];
  for (int p = 0; p < 9; ++p) odd[p] = f.up[p] - f.down[p];
  const Vector3<Real> j = momentum<Real>(odd);
  Vector3<Real> force{splat(static_cast<Real>(fields.body_force[0])), splat(static_cast<Real>(fields.body_force[1])),
                      splat(static_cast<Real>(fields.body_force[2]))};
  if (fields.force != nullptr) force = load_vectors<Real>(fields.force + std::ptrdiff_t{s.strip} * 24);
  Vector3<Real> u{j.x + Real(0.5) * force.x, j.y + Real(0.5) * force.y, j.z + Real(0.5) * force.z};
  Real* const to = fields.velocity + std::ptrdiff_t{s.strip} * 24;
  if (s.fluid != 0xff) {
    const PackMask<Real> fluid = mask_of<Real>(s.fluid);
    const Vector3<Real> before = load_vectors<Real>(to);
    u = {fluid ? u.x : before.x, fluid ? u.y : before.y, fluid ? u.z : before.z};
  }
  store_vectors(to, u);
}

template <class Real>
void find_velocity(const FluidFields<Real>& fields, std::span<const FluidStrip> strips) {
  const Places<Real> places(fields.populations, fields.odd_step);
  const FluidStrip* const end = strips.data() + strips.size();
  for (const FluidStrip* s = strips.data(); s != end; ++s) {
    prefetch(fields, places, s);
    find_strip_velocity(fields, places, *s);
  }
}

}  // namespace npfem::flow::NPFEM_ISA
