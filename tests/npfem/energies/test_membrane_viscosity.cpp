// SPDX-License-Identifier: MPL-2.0
// The membrane viscosity of one triangle: the contract of an energy, and its tension against the closed form
//   T = 2 eta_s dev(r) + eta_d tr(r) 1,  r the rate of strain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "energies/membrane_viscosity.h"
#include "energies/skalak.h"
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

/// Tension (per length) of a flat triangle that carries the forces -gradient: the virial over its area.
struct Tension {
  double xx, xy, yx, yy;
};

Tension tension(const V (&x)[3], const V (&gradient)[3]) {
  const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
  Tension sum{0, 0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    sum.xx += gradient[i].x * x[i].x / area, sum.xy += gradient[i].x * x[i].y / area;
    sum.yx += gradient[i].y * x[i].x / area, sum.yy += gradient[i].y * x[i].y / area;
  }
  return sum;
}

/// A triangle that shears, turns and grows: x = F(t) X.
struct Motion {
  static constexpr double f(double t) { return 1 + 0.3 * t + 0.2 * t * t; }
  static constexpr double g(double t) { return 0.4 * t + 0.5 * t * t; }
  static constexpr double h(double t) { return 1 - 0.2 * t; }

  static void shape(double t, V (&x)[3]) {
    const V reference[3] = {{0.1, 0.2, 0}, {1.1, 0.1, 0}, {0.4, 0.9, 0}};
    for (int i = 0; i < 3; ++i) {
      const double u = f(t) * reference[i].x + g(t) * reference[i].y, v = h(t) * reference[i].y, turn = 0.7 * t;
      x[i] = {std::cos(turn) * u - std::sin(turn) * v, std::sin(turn) * u + std::cos(turn) * v, 0};
    }
  }
  /// The rate of strain in the frame that turns along: the symmetric part of F' F^-1.
  static void rate(double t, double& xx, double& xy, double& yy) {
    const double df = 0.3 + 0.4 * t, dg = 0.4 + t, dh = -0.2;
    xx = df / f(t), yy = dh / h(t), xy = 0.5 * (dg - g(t) * df / f(t)) / h(t);
  }
};

/// Largest error of the tension at t = 0.4 after a step of dt.
double tension_error(double dt, double past) {
  const double end = 0.4, h = dt * (1 - past);
  V before[3], now[3], after[3], last[3], move[3], gradient[3];
  Motion::shape(end - 2 * dt, before);
  Motion::shape(end - dt, now);
  Motion::shape(end, after);
  for (int i = 0; i < 3; ++i) last[i] = now[i] - before[i], move[i] = after[i] - now[i];
  const MembraneViscosity::Params<double> eta{3, 2}, over_h{eta.shear / h, eta.dilatational / h};
  MembraneViscosity::energy_gradient(move, MembraneViscosity::start(now, last, past), over_h, gradient);
  const V axis{0, 0, 1}, nowhere{0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    after[i] = testing::moved(after[i], axis, -0.7 * end, nowhere);
    gradient[i] = testing::moved(gradient[i], axis, -0.7 * end, nowhere);
  }
  const Tension t = tension(after, gradient);
  double xx, xy, yy;
  Motion::rate(end, xx, xy, yy);
  const double mean = eta.dilatational * (xx + yy), difference = eta.shear * (xx - yy);
  return std::max({std::abs(t.xx - mean - difference), std::abs(t.yy - mean + difference),
                   std::abs(t.xy - 2 * eta.shear * xy), std::abs(t.yx - t.xy)});
}

TEST(MembraneViscosity, TensionIsThatOfTheRateOfStrainToTheOrderOfTheIntegrator) {
  for (const double past : {0.0, 1.0 / 3}) {
    const int order = past > 0 ? 2 : 1;
    double error = tension_error(0.02, past);
    for (const double dt : {0.01, 0.005, 0.0025}) {
      const double finer = tension_error(dt, past);
      EXPECT_NEAR(std::log2(error / finer), order, 0.1) << "dt = " << dt;
      error = finer;
    }
    EXPECT_LT(error, past > 0 ? 1e-4 : 2e-2);
  }
}

TEST(MembraneViscosity, CreepUnderAConstantShear) {
  // Kelvin-Voigt: a sheet of modulus G_s under the shear resultant T_s (half the difference of its tensions) takes the
  // strain (T_s/2 G_s)(1 - exp(-t G_s/eta_s)); by implicit Euler 1 - (1 + dt G_s/eta_s)^-n in place of the bracket.
  const double modulus = 3, viscosity = 600, resultant = 1e-3, dt = 10;
  const V reference[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, none[3]{};
  const Skalak::Params<double> elastic{modulus, 1};
  const auto rest = Membrane<Skalak>::rest(reference, elastic);
  double strain = 0;
  for (int n = 1; n <= 40; ++n) {
    const V now[3] = {{0, 0, 0}, {std::exp(strain), 0, 0}, {0, std::exp(-strain), 0}};
    const auto start = MembraneViscosity::start(now, none, 0.0);
    double low = strain, high = strain + 1e-3;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = 0.5 * (low + high);
      const V x[3] = {{0, 0, 0}, {std::exp(middle), 0, 0}, {0, std::exp(-middle), 0}};
      const V move[3] = {none[0], x[1] - now[1], x[2] - now[2]};
      V stiff[3], viscous[3];
      Membrane<Skalak>::energy_gradient(x, rest, elastic, stiff);
      MembraneViscosity::energy_gradient(move, start, MembraneViscosity::Params<double>{viscosity / dt, 0.0}, viscous);
      const Tension a = tension(x, stiff), b = tension(x, viscous);
      (0.5 * (a.xx - a.yy + b.xx - b.yy) < resultant ? low : high) = middle;
    }
    strain = low;
    const double exact = resultant / (2 * modulus) * (1 - std::pow(1 + dt * modulus / viscosity, -n));
    EXPECT_NEAR(strain, exact, 1e-3 * exact) << n;
  }
}

TEST(MembraneViscosity, FiniteWhenCollapsed) {
  Random random{9};
  V sound[3], none[3]{}, gradient[3], last[3];
  testing::random_element(random, 0.1, sound);
  random_moves(random, 0.1, last);
  const V on_a_point[3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, on_a_line[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const auto expect_finite = [&](const V(&from)[3], const V(&before)[3], const V(&to)[3]) {
    const V move[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const Start start = MembraneViscosity::start(from, before, 1.0 / 3);
    EXPECT_TRUE(std::isfinite(MembraneViscosity::energy_gradient(move, start, per_time, gradient)));
    for (const V& g : gradient) EXPECT_TRUE(std::isfinite(largest(g)));
  };
  for (const auto& collapsed : {on_a_point, on_a_line}) {
    const V to[3] = {collapsed[0], collapsed[1], collapsed[2]},
            back[3] = {to[0] - sound[0], to[1] - sound[1], to[2] - sound[2]};
    expect_finite(sound, none, to);
    expect_finite(sound, last, to);
    expect_finite(to, none, sound);
    expect_finite(to, last, sound);
    expect_finite(to, back, to);
  }
  // One that was four times as large a step ago would go on to nothing: its strain counts from x_n.
  const V shrunk[3] = {4.0 * (sound[0] - sound[0]), -4.0 * (sound[1] - sound[0]), -4.0 * (sound[2] - sound[0])};
  const Start start = MembraneViscosity::start(sound, shrunk, 1.0 / 3);
  EXPECT_EQ(start.area_lag, 0.0);
  EXPECT_EQ(MembraneViscosity::energy_gradient(none, start, per_time, gradient), 0.0);
}

TEST(MembraneViscosity, FloatKeepsTheForcesOfSmallDisplacements) {
  // A displacement of 1e-6 um of a triangle at 10 um, far below the last digit of a float position.
  Random random{11};
  V x[3], move[3], none[3]{}, gradient[3];
  Vec3<float> x_float[3], move_float[3], none_float[3]{}, gradient_float[3];
  testing::random_element(random, 0.1, x);
  random_moves(random, 1e-6, move);
  for (int i = 0; i < 3; ++i) {
    x[i] = {float(x[i].x + 10), float(x[i].y), float(x[i].z)};
    move[i] = {float(move[i].x), float(move[i].y), float(move[i].z)};
    x_float[i] = {float(x[i].x), float(x[i].y), float(x[i].z)};
    move_float[i] = {float(move[i].x), float(move[i].y), float(move[i].z)};
  }
  MembraneViscosity::energy_gradient(move, MembraneViscosity::start(x, none, 0.0), per_time, gradient);
  const MembraneViscosity::Params<float> per_time_float{float(per_time.shear), float(per_time.dilatational)};
  const auto start = MembraneViscosity::start(x_float, none_float, 0.0f);
  MembraneViscosity::energy_gradient(move_float, start, per_time_float, gradient_float);
  double size = 0;
  for (const V& g : gradient) size = std::max(size, largest(g));
  EXPECT_GT(size, 1e-7);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(gradient_float[i].x, gradient[i].x, 1e-5 * size);
    EXPECT_NEAR(gradient_float[i].y, gradient[i].y, 1e-5 * size);
    EXPECT_NEAR(gradient_float[i].z, gradient[i].z, 1e-5 * size);
  }
}

}  // namespace
}  // namespace npfem
