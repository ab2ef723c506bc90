// SPDX-License-Identifier: MPL-2.0
#include "output/fixed_point_sum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"
#include "lattice/compensated_sum.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

constexpr int terms = 5000;

TEST(FixedPointSum, DoesNotKnowWhoAdded) {
  FixedPointSum shared, alone;
  CompensatedSum plain;
  for (int n = 0; n < terms; ++n) {
    const double term = flows::random_value(n) * (n % 7 == 0 ? 100 : 1e-4);
    if (n * 3 % world().size() == world().rank()) shared.add(term);
    alone.add(term);
    plain.add(term);
  }
  SerialCommunicator self;
  EXPECT_EQ(shared.total(world()), alone.total(self));
  EXPECT_NEAR(alone.total(self), plain.value(), terms * std::ldexp(1.0, -50));
}

TEST(FixedPointSum, IsNoNumberWhereATermIsNone) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 2000.0}) {
    FixedPointSum sum;
    sum.add(1);
    if (world().rank() == world().size() - 1) sum.add(bad);
    EXPECT_TRUE(std::isnan(sum.total(world())));
  }
}

}  // namespace
}  // namespace npfem::flow
