// SPDX-License-Identifier: MPL-2.0
#include "lattice/threads.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace npfem::flow {

void set_lattice_threads([[maybe_unused]] int threads) {
#ifdef _OPENMP
  omp_set_num_threads(threads);
#endif
}

}  // namespace npfem::flow
