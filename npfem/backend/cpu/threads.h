// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <exception>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace npfem::cpu {

/// Threads to use: as asked for, or where that is 0 those of OMP_NUM_THREADS and without it one, because a host with
/// threads or ranks of its own must not be slowed down by ours unasked. Never more than there is work for.
inline int thread_count(int asked_for, int pieces) {
  int threads = asked_for;
#ifdef _OPENMP
  if (threads == 0) threads = std::getenv("OMP_NUM_THREADS") ? omp_get_max_threads() : 1;
#else
  threads = 1;
#endif
  return std::clamp(threads, 1, std::max(pieces, 1));
}

/// Calls work(piece, thread) for each piece; which thread takes which is not fixed, so results may not depend on it.
/// What a piece throws is thrown here, once all threads have ended: it must not leave a thread.
template <class Work>
void for_each_piece(int pieces, int threads, Work&& work) {
#ifdef _OPENMP
  std::exception_ptr thrown;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
  for (int piece = 0; piece < pieces; ++piece) {
    try {
      work(piece, omp_get_thread_num());
    } catch (...) {
#pragma omp critical
      thrown = std::current_exception();
    }
  }
  if (thrown) std::rethrow_exception(thrown);
#else
  for (int piece = 0; piece < pieces; ++piece) work(piece, 0);
  static_cast<void>(threads);
#endif
}

}  // namespace npfem::cpu
