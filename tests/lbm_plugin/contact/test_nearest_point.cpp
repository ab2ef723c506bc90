// SPDX-License-Identifier: MPL-2.0
#include "contact/nearest_point.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "flows.h"

namespace npfem::flow {
namespace {

// Everything that is nearest obeys: no other point of the triangle is nearer, and those of a fine net come close.
TEST(NearestPoint, IsNearerThanAllOthers) {
  constexpr int net = 60;
  std::array<int, 4> zeros{};
  for (int n = 0; n < 400; ++n) {
    const Corners corner{flows::random_vector(n, 0, 1), flows::random_vector(n, 1, 1), flows::random_vector(n, 2, 1)};
    const Vec3 point = flows::random_vector(n, 3, 2);
    const auto weight = nearest_on_triangle(point, corner);
    const double nearest = norm(subtract(point, weighted(weight, corner)));
    EXPECT_NEAR(weight[0] + weight[1] + weight[2], 1, 1e-14);
    for (const double w : weight) EXPECT_GE(w, 0);
    ++zeros[static_cast<std::size_t>(std::count(weight.begin(), weight.end(), 0.0))];
    double best = 1e9;
    for (int i = 0; i <= net; ++i) {
      for (int j = 0; i + j <= net; ++j) {
        const double u = double(i) / net, v = double(j) / net;
        best = std::min(best, norm(subtract(point, weighted({1 - u - v, u, v}, corner))));
      }
    }
    EXPECT_LE(nearest, best + 1e-12);
    EXPECT_GE(nearest, best - 0.06);
  }
  for (int kind = 0; kind < 3; ++kind) EXPECT_GT(zeros[std::size_t(kind)], 10) << "face, edge and corner all occur";
}

TEST(NearestPoint, OfATriangleWithoutAreaIsANumber) {
  const Corners line{Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 0, 0}};
  const auto weight = nearest_on_triangle({0.25, 1, 0}, line);
  const Vec3 q = weighted(weight, line);
  EXPECT_EQ(q[0], q[0]);
}

}  // namespace
}  // namespace npfem::flow
