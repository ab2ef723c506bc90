// SPDX-License-Identifier: MPL-2.0
#pragma once

// The eight numbers of one strip as one value: a register of AVX-512 in double precision, of AVX2 in single precision,
// several registers otherwise.

#include <cstddef>
#include <cstdint>

#include "lattice/kernel/isa.h"

namespace npfem::flow::NPFEM_ISA {

template <class Real>
struct PackOf;
template <>
struct PackOf<double> {
  typedef double Pack __attribute__((vector_size(64), may_alias));
  typedef double Unaligned __attribute__((vector_size(64), aligned(8), may_alias));
  typedef std::int64_t Mask __attribute__((vector_size(64)));
  using Integer = std::int64_t;
};
template <>
struct PackOf<float> {
  typedef float Pack __attribute__((vector_size(32), may_alias));
  typedef float Unaligned __attribute__((vector_size(32), aligned(4), may_alias));
  typedef std::int32_t Mask __attribute__((vector_size(32)));
  using Integer = std::int32_t;
};
template <class Real>
using Pack = typename PackOf<Real>::Pack;
template <class Real>
using PackMask = typename PackOf<Real>::Mask;

template <class Real>
NPFEM_INLINE Pack<Real>& pack_at(Real* numbers) {
  return *reinterpret_cast<Pack<Real>*>(numbers);
}
template <class Real>
NPFEM_INLINE const Pack<Real>& pack_at(const Real* numbers) {
  return *reinterpret_cast<const Pack<Real>*>(numbers);
}

template <class Real>
NPFEM_INLINE Pack<Real> splat(Real value) {
  return Pack<Real>{} + value;
}

// All ones in the lanes whose bit is set.
template <class Real>
NPFEM_INLINE PackMask<Real> mask_of(std::uint8_t bits) {
  const PackMask<Real> bit_of_lane = {1, 2, 4, 8, 16, 32, 64, 128};
  const PackMask<Real> all = PackMask<Real>{} + static_cast<typename PackOf<Real>::Integer>(bits);
  return (all & bit_of_lane) != PackMask<Real>{};
}

// Lane l of the result is lane l + 1 of the strip `here`, the last one being the first of the strip that follows.
template <class P>
NPFEM_INLINE P from_next_node(P here, P following) {
  return __builtin_shufflevector(here, following, 1, 2, 3, 4, 5, 6, 7, 8);
}
// The reverse: what the strip holds after `moved` has gone one node up ...
template <class P>
NPFEM_INLINE P to_next_node(P here, P moved) {
  return __builtin_shufflevector(here, moved, 0, 8, 9, 10, 11, 12, 13, 14);
}
// ... and what the strip that follows holds.
template <class P>
NPFEM_INLINE P to_following_strip(P following, P moved) {
  return __builtin_shufflevector(following, moved, 15, 1, 2, 3, 4, 5, 6, 7);
}

template <class Real>
struct Vector3 {
  Pack<Real> x, y, z;
};

// Between xyzxyz... in memory and one pack per component.
template <class Real>
NPFEM_INLINE Vector3<Real> load_vectors(const Real* xyz) {
  using P = Pack<Real>;
  const P a = pack_at(xyz), b = pack_at(xyz + 8), c = pack_at(xyz + 16);
  const P x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
  const P y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
  const P z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
  return {__builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13),
          __builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14),
          __builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15)};
}

template <class Real>
NPFEM_INLINE void store_vectors(Real* xyz, const Vector3<Real>& v) {
  using P = Pack<Real>;
  const P a = __builtin_shufflevector(v.x, v.y, 0, 8, 0, 1, 9, 0, 2, 10);
  const P b = __builtin_shufflevector(v.x, v.y, 0, 3, 11, 0, 4, 12, 0, 5);
  const P c = __builtin_shufflevector(v.x, v.y, 13, 0, 6, 14, 0, 7, 15, 0);
  pack_at(xyz) = __builtin_shufflevector(a, v.z, 0, 1, 8, 3, 4, 9, 6, 7);
  pack_at(xyz + 8) = __builtin_shufflevector(b, v.z, 10, 1, 2, 11, 4, 5, 12, 7);
  pack_at(xyz + 16) = __builtin_shufflevector(c, v.z, 0, 13, 2, 3, 14, 5, 6, 15);
}

}  // namespace npfem::flow::NPFEM_ISA
