// SPDX-License-Identifier: MPL-2.0
// A pack of SIMD lanes as a number type for the energies. Included once per instruction set, inside the namespace
// NPFEM_ISA, so that code compiled for different instruction sets never shares a symbol.
#pragma once

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include "backend/cpu/kernel/isa.h"
#include "energies/vec3.h"

#define NPFEM_LANES_INLINE [[gnu::always_inline]] inline

namespace npfem::NPFEM_ISA {

template <class R>
struct IntegerOf;
template <>
struct IntegerOf<double> {
  using type = long long;
};
template <>
struct IntegerOf<float> {
  using type = int;
};

/// One truth value per lane.
template <class R, int W>
struct Mask {
  typedef typename IntegerOf<R>::type Vector __attribute__((vector_size(W * sizeof(R))));
  Vector v;

  NPFEM_LANES_INLINE static Mask none() { return {Vector{}}; }
  NPFEM_LANES_INLINE static Mask all() { return {~Vector{}}; }
  NPFEM_LANES_INLINE friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
  NPFEM_LANES_INLINE friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
  NPFEM_LANES_INLINE friend Mask operator!(Mask a) { return {~a.v}; }
  NPFEM_LANES_INLINE bool operator[](int lane) const { return v[lane] != 0; }
  NPFEM_LANES_INLINE void set(int lane, bool value) { v[lane] = value ? -1 : 0; }
  NPFEM_LANES_INLINE bool any() const {
    typename IntegerOf<R>::type either = 0;
    for (int lane = 0; lane < W; ++lane) either |= v[lane];
    return either != 0;
  }
  NPFEM_LANES_INLINE int count() const {
    int lanes = 0;
    for (int lane = 0; lane < W; ++lane) lanes += v[lane] != 0 ? 1 : 0;
    return lanes;
  }
};

/// W numbers, one per lane. `may_alias`: fields of numbers are read as packs.
template <class R, int W>
struct Pack {
  typedef R Vector __attribute__((vector_size(W * sizeof(R)), may_alias));
  Vector v;

  Pack() = default;
  /// A number is a pack of equal lanes.
  template <class Number>
  requires(sizeof(Number) <= sizeof(double) && static_cast<Number>(1) == 1) NPFEM_LANES_INLINE Pack(Number same)
      : v(static_cast<R>(same) - Vector{}) {}  // NOLINT: implicit
  NPFEM_LANES_INLINE static Pack from(const R (&lanes)[W]) {
    Pack p;
    __builtin_memcpy(&p.v, lanes, sizeof(p.v));
    return p;
  }
  NPFEM_LANES_INLINE static Pack of(Vector lanes) {
    Pack p;
    p.v = lanes;
    return p;
  }
  NPFEM_LANES_INLINE R operator[](int lane) const { return v[lane]; }
  NPFEM_LANES_INLINE void set(int lane, R value) { v[lane] = value; }

  NPFEM_LANES_INLINE friend Pack operator+(Pack a, Pack b) { return of(a.v + b.v); }
  NPFEM_LANES_INLINE friend Pack operator-(Pack a, Pack b) { return of(a.v - b.v); }
  NPFEM_LANES_INLINE friend Pack operator*(Pack a, Pack b) { return of(a.v * b.v); }
  NPFEM_LANES_INLINE friend Pack operator/(Pack a, Pack b) { return of(a.v / b.v); }
  NPFEM_LANES_INLINE friend Pack operator-(Pack a) { return of(-a.v); }
  NPFEM_LANES_INLINE Pack& operator+=(Pack b) {
    v += b.v;
    return *this;
  }
  NPFEM_LANES_INLINE Pack& operator-=(Pack b) {
    v -= b.v;
    return *this;
  }
  NPFEM_LANES_INLINE friend Mask<R, W> operator<(Pack a, Pack b) { return {a.v < b.v}; }
  NPFEM_LANES_INLINE friend Mask<R, W> operator>(Pack a, Pack b) { return {a.v > b.v}; }
  NPFEM_LANES_INLINE friend Mask<R, W> operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
  NPFEM_LANES_INLINE friend Pack select(Mask<R, W> condition, Pack yes, Pack no) {
    return of(condition.v ? yes.v : no.v);
  }
  NPFEM_LANES_INLINE friend Pack square_root(Pack a) { return of(root(a.v)); }

 private:
  NPFEM_LANES_INLINE static Vector root(Vector a) {
#ifdef __AVX512F__
    if constexpr (sizeof(Vector) == 64 && sizeof(R) == 8) return (Vector)_mm512_maskz_sqrt_pd(0xff, (__m512d)a);
    if constexpr (sizeof(Vector) == 64 && sizeof(R) == 4) return (Vector)_mm512_maskz_sqrt_ps(0xffff, (__m512)a);
#endif
#ifdef __AVX__
    if constexpr (sizeof(Vector) == 32 && sizeof(R) == 8) return (Vector)_mm256_sqrt_pd((__m256d)a);
    if constexpr (sizeof(Vector) == 32 && sizeof(R) == 4) return (Vector)_mm256_sqrt_ps((__m256)a);
#endif
#ifdef __SSE2__
    if constexpr (sizeof(Vector) == 16 && sizeof(R) == 8) return (Vector)_mm_sqrt_pd((__m128d)a);
    if constexpr (sizeof(Vector) == 16 && sizeof(R) == 4) return (Vector)_mm_sqrt_ps((__m128)a);
#endif
    for (int lane = 0; lane < W; ++lane) a[lane] = square_root_of(a[lane]);
    return a;
  }
  NPFEM_LANES_INLINE static double square_root_of(double a) {
    return __builtin_sqrt(a);
  }
  NPFEM_LANES_INLINE static float square_root_of(float a) {
    return __builtin_sqrtf(a);
  }
};

template <class R, int W>
NPFEM_LANES_INLINE Pack<R, W> magnitude(Pack<R, W> a) {
  return select(a < Pack<R, W>(R(0)), -a, a);
}

/// False for infinities and for what is not a number.
template <class R, int W>
NPFEM_LANES_INLINE Mask<R, W> is_finite(Pack<R, W> a) {
  return a - a <= Pack<R, W>(R(0));
}

/// Lanes converted one by one.
template <class To, class R, int W>
NPFEM_LANES_INLINE Pack<To, W> convert(Pack<R, W> a) {
  return Pack<To, W>::of(__builtin_convertvector(a.v, typename Pack<To, W>::Vector));
}

}  // namespace npfem::NPFEM_ISA
