// SPDX-License-Identifier: MPL-2.0
// What makes a regularised delta function usable (Peskin, Acta Numerica 2002, section 6), for every position of the
// vertex between the nodes.
#include "immersed_boundary/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace npfem::flow {
namespace {

// Offsets over the range of the kernel, both ends included or approached.
std::vector<double> offsets(double low) {
  std::vector<double> all;
  for (int i = 0; i < 1000; ++i) all.push_back(low + i / 1000.0);
  all.push_back(low + 1.0 - 1e-15);
  return all;
}

template <int Points>
struct Sums {
  double total = 0, moment = 0, squares = 0;
  // The anchor (see kernel.h) is node number `anchor` of the support.
  Sums(double offset, int anchor) {
    const auto w = Kernel<Points>::weights(offset);
    for (int p = 0; p < Points; ++p) {
      const double weight = w[static_cast<std::size_t>(p)];
      total += weight;
      moment += weight * (p - anchor - offset);
      squares += weight * weight;
    }
  }
};

TEST(Kernel, TwoPointsIsLinearInterpolation) {
  for (const double offset : offsets(0)) {
    const Sums<2> sums(offset, 0);
    EXPECT_NEAR(sums.total, 1, 2e-16);
    EXPECT_NEAR(sums.moment, 0, 3e-16);
  }
}

TEST(Kernel, ThreePointsKeepsForceTorqueAndStrength) {
  for (const double offset : offsets(-0.5)) {
    const Sums<3> sums(offset, 1);
    EXPECT_NEAR(sums.total, 1, 1e-15);
    EXPECT_NEAR(sums.moment, 0, 1e-15);
    EXPECT_NEAR(sums.squares, 0.5, 1e-15);
  }
}

TEST(Kernel, FourPointsKeepsForceTorqueAndStrength) {
  for (const double offset : offsets(0)) {
    const Sums<4> sums(offset, 1);
    EXPECT_NEAR(sums.total, 1, 1e-15);
    EXPECT_NEAR(sums.moment, 0, 1e-15);
    EXPECT_NEAR(sums.squares, 0.375, 1e-15);
  }
}

TEST(Kernel, FourPointsWeighsEvenAndOddNodesAlike) {
  for (const double offset : offsets(0)) {
    const auto w = Kernel<4>::weights(offset);
    EXPECT_NEAR(w[0] + w[2], 0.5, 1e-15);
    EXPECT_NEAR(w[1] + w[3], 0.5, 1e-15);
  }
}

// The formulas of the papers, as functions of the distance from a node.
double roma(double r) {
  r = std::abs(r);
  if (r <= 0.5) return (1 + std::sqrt(1 - 3 * r * r)) / 3;
  return r <= 1.5 ? (5 - 3 * r - std::sqrt(1 - 3 * (1 - r) * (1 - r))) / 6 : 0;
}
double peskin(double r) {
  r = std::abs(r);
  if (r <= 1) return (3 - 2 * r + std::sqrt(1 + 4 * r - 4 * r * r)) / 8;
  return r <= 2 ? (5 - 2 * r - std::sqrt(-7 + 12 * r - 4 * r * r)) / 8 : 0;
}

TEST(Kernel, IsThePublishedFunctionOfTheDistance) {
  for (int i = 1; i < 1000; ++i) {
    const double offset = i / 1000.0;
    for (int p = 0; p < 4; ++p) {
      EXPECT_NEAR(Kernel<4>::weights(offset)[static_cast<std::size_t>(p)], peskin(p - 1 - offset), 1e-14);
    }
    const double around = offset - 0.5;
    for (int p = 0; p < 3; ++p) {
      EXPECT_NEAR(Kernel<3>::weights(around)[static_cast<std::size_t>(p)], roma(p - 1 - around), 1e-14);
    }
  }
}

TEST(Kernel, VanishesAtTheEndOfItsSupport) {
  EXPECT_NEAR(Kernel<4>::weights(0)[3], 0, 1e-16);
  EXPECT_NEAR(Kernel<4>::weights(1)[0], 0, 1e-16);
  EXPECT_NEAR(Kernel<3>::weights(0.5)[0], 0, 1e-16);
  EXPECT_NEAR(Kernel<3>::weights(-0.5)[2], 0, 1e-16);
}

}  // namespace
}  // namespace npfem::flow
