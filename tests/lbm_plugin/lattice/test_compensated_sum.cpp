// SPDX-License-Identifier: MPL-2.0
#include "lattice/compensated_sum.h"

#include <gtest/gtest.h>

namespace npfem::flow {
namespace {

TEST(CompensatedSum, KeepsWhatPlainAdditionLoses) {
  CompensatedSum large_first;
  for (const double term : {1.0, 1e100, 1.0, -1e100}) large_first.add(term);
  EXPECT_EQ(large_first.value(), 2.0);

  CompensatedSum tenths;
  for (int i = 0; i < 10'000'000; ++i) tenths.add(0.1);
  EXPECT_EQ(tenths.value(), 1e6);
}

}  // namespace
}  // namespace npfem::flow
