// SPDX-License-Identifier: MPL-2.0
#include "bench/fma_peak.h"

#include <algorithm>

#include "bench/clock.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace npfem::app::bench {
namespace {

constexpr int chains = 12;  ///< independent sums: more than latency times units, fewer than registers
constexpr int rounds = 200000;

template <class T, int bytes>
struct Vector {
  typedef T type __attribute__((vector_size(bytes)));
};

/// `madd(sum, factor)` on all chains, `rounds` times. What comes out depends on every operation.
#define NPFEM_PEAK_LOOP(V, T, MADD)                      \
  V sum[chains];                                         \
  for (int k = 0; k < chains; ++k) sum[k] = V{} + T(k);  \
  const V factor = V{} + T(0.999), term = V{} + T(1e-3); \
  for (int round = 0; round < rounds; ++round) {         \
    for (int k = 0; k < chains; ++k) sum[k] = MADD;      \
  }                                                      \
  T total = 0;                                           \
  for (int k = 0; k < chains; ++k) total += sum[k][0];   \
  return total

template <class T>
T peak_baseline() {
  using V = typename Vector<T, 16>::type;
  NPFEM_PEAK_LOOP(V, T, sum[k] * factor + term);
}

#ifdef __x86_64__
__attribute__((target("avx2,fma"))) double peak_avx2_double() {
  using V = Vector<double, 32>::type;
  NPFEM_PEAK_LOOP(V, double, _mm256_fmadd_pd(sum[k], factor, term));
}
__attribute__((target("avx2,fma"))) float peak_avx2_float() {
  using V = Vector<float, 32>::type;
  NPFEM_PEAK_LOOP(V, float, _mm256_fmadd_ps(sum[k], factor, term));
}
__attribute__((target("avx512f"))) double peak_avx512_double() {
  using V = Vector<double, 64>::type;
  NPFEM_PEAK_LOOP(V, double, _mm512_fmadd_pd(sum[k], factor, term));
}
__attribute__((target("avx512f"))) float peak_avx512_float() {
  using V = Vector<float, 64>::type;
  NPFEM_PEAK_LOOP(V, float, _mm512_fmadd_ps(sum[k], factor, term));
}
#endif
#undef NPFEM_PEAK_LOOP

template <class T>
double best_gflops(T (*loop)(), int lanes) {
  double best = 0;
  volatile T sink = 0;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const Stopwatch watch(Clock::cpu);
    sink = loop();
    best = std::max(best, 2e-3 * lanes * chains * rounds / watch.us());
  }
  static_cast<void>(sink);
  return best;
}

}  // namespace

FmaPeak measure_fma_peak() {
#ifdef __x86_64__
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  if (has_avx2 && has_avx512) return {"avx512", best_gflops(peak_avx512_double, 8), best_gflops(peak_avx512_float, 16)};
  if (has_avx2) return {"avx2", best_gflops(peak_avx2_double, 4), best_gflops(peak_avx2_float, 8)};
#endif
  return {"baseline", best_gflops(peak_baseline<double>, 2), best_gflops(peak_baseline<float>, 4)};
}

}  // namespace npfem::app::bench
