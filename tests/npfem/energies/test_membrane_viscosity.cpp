// SPDX-License-Identifier: MPL-2.0
// The membrane viscosity of one triangle: the contract of an energy, and its tension against the closed form
//   T = 2 eta_s dev(D) + eta_d tr(D) 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "energies/membrane_viscosity.h"
#include "random_shape.h"

namespace npfem {
namespace {

using testing::Random;
using V = Vec3<double>;
using Start = MembraneViscosity::Start<double>;
constexpr MembraneViscosity::Params<double> per_time{3.0, 2.0};

double largest(const V& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

void random_moves(Random& random, double size, V (&moves)[3]) {
  for (V& m : moves) m = random.vector(size);
}

TEST(MembraneViscosity, NoForceWithoutDisplacement) {
  Random random{3};
  for (int k = 0; k < 20; ++k) {
    V x[3], none[3]{}, gradient[3];
    testing::random_element(random, 0.2, x);
    EXPECT_EQ(MembraneViscosity::energy_gradient(none, MembraneViscosity::start(x, none, 1.0 / 3), per_time, gradient),
              0.0);
    for (const V& g : gradient) EXPECT_EQ(largest(g), 0.0);
  }
}

TEST(MembraneViscosity, GradientEqualsCentralDifferences) {
  Random random{5};
  for (int k = 0; k < 50; ++k) {
    V x[3], last[3], move[3], gradient[3], unused[3];
    testing::random_element(random, 0.2, x);
    random_moves(random, 0.05, last);
    random_moves(random, 0.1, move);
    const Start start = MembraneViscosity::start(x, last, k % 2 == 0 ? 0.0 : 1.0 / 3);
    const double energy = MembraneViscosity::energy_gradient(move, start, per_time, gradient);
    EXPECT_GT(energy, 0);
    V force{0, 0, 0}, torque{0, 0, 0};
    double size = 0;
    for (int i = 0; i < 3; ++i) {
      force = force + gradient[i];
      torque = torque + cross(x[i] + move[i], gradient[i]);
      size = std::max(size, largest(gradient[i]));
    }
    EXPECT_LT(largest(force), 1e-13 * size);
    EXPECT_LT(largest(torque), 1e-12 * size);
    const double h = 1e-5;
    for (int i = 0; i < 3; ++i) {
      for (double V::*axis : {&V::x, &V::y, &V::z}) {
        const double at = move[i].*axis;
        move[i].*axis = at + h;
        const double above = MembraneViscosity::energy_gradient(move, start, per_time, unused);
        move[i].*axis = at - h;
        const double below = MembraneViscosity::energy_gradient(move, start, per_time, unused);
        move[i].*axis = at;
        EXPECT_NEAR((above - below) / (2 * h), gradient[i].*axis, 1e-7 * size + 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace npfem
