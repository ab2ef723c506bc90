// SPDX-License-Identifier: MPL-2.0
// The same bits for any number of threads.

#include <gtest/gtest.h>

#include "communicator/serial_communicator.h"
#include "invariance.h"

#ifdef _OPENMP
#include <omp.h>

namespace npfem::flow {
namespace {

TEST(Invariance, SameBitsForAnyNumberOfThreads) {
  SerialCommunicator communicator;
  for (const auto& run : flows::invariance_cases()) {
    omp_set_num_threads(1);
    const std::uint64_t one = flows::hash_after_run(communicator, run, 20);
    for (const int threads : {2, 3}) {
      omp_set_num_threads(threads);
      EXPECT_EQ(flows::hash_after_run(communicator, run, 20), one) << run.name << ' ' << threads;
    }
    omp_set_num_threads(1);
  }
}

}  // namespace
}  // namespace npfem::flow
#endif
