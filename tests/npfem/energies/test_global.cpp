// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include "energies/energy_list.h"
#include "sample_params.h"

namespace npfem {
namespace {

const CellRest<double> rest{130, 92};

template <class E>
class CellContract : public ::testing::Test {};
using Cells = ::testing::Types<GlobalArea, GlobalVolume, LineageVolume>;
TYPED_TEST_SUITE(CellContract, Cells);

TYPED_TEST(CellContract, NothingAtRest) {
  const auto r = TypeParam::respond(CellSums<double>{130, 92, 69}, rest, testing::sample_params<TypeParam>());
  EXPECT_EQ(r.energy, 0);
  EXPECT_EQ(r.by_area, 0);
  EXPECT_EQ(r.by_volume, 0);
}

TYPED_TEST(CellContract, SlopesEqualCentralDifferences) {
  const auto p = testing::sample_params<TypeParam>();
  const double h = 1e-4;
  const auto energy = [&](double a, double v) {
    return TypeParam::respond(CellSums<double>{a, v, 69}, rest, p).energy;
  };
  const auto r = TypeParam::respond(CellSums<double>{133, 90, 69}, rest, p);
  EXPECT_GT(r.energy, 0);
  EXPECT_NEAR((energy(133 + h, 90) - energy(133 - h, 90)) / (2 * h), r.by_area, 1e-6);
  EXPECT_NEAR((energy(133, 90 + h) - energy(133, 90 - h)) / (2 * h), r.by_volume, 1e-6);
}

TEST(CellEnergies, TheContractCoversTheWholeList) {
  static_assert(std::is_same_v<CellEnergies, TypeList<GlobalArea, GlobalVolume, LineageVolume>>);
}

}  // namespace
}  // namespace npfem
