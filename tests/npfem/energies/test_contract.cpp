// SPDX-License-Identifier: MPL-2.0
// The contract that every energy of the list keeps: nothing at rest, no net force, no net torque, gradient equal to
// finite differences, objective under rigid motion, finite for collapsed shapes, a positive-semidefinite weight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "energies/energy_list.h"
#include "random_shape.h"
#include "sample_params.h"

namespace npfem {
namespace {

using testing::Random;
using V = Vec3<double>;

template <class List>
struct GoogleTypes;
template <class... Es>
struct GoogleTypes<TypeList<Es...>> {
  using type = ::testing::Types<Es...>;
};

template <class E>
class ElementContract : public ::testing::Test {
 protected:
  static constexpr int n = E::num_vertices;
  using Params = typename E::template Params<double>;
  using Rest = typename E::template Rest<double>;

  const Params params = testing::sample_params<E>();
  V reference[n];
  Random random{7};

  Rest new_rest() {
    testing::random_element(random, 0.15, reference);
    return E::rest(reference, params);
  }
  double energy(const V (&x)[n], const Rest& rest) const {
    V unused[n];
    return E::energy_gradient(x, rest, params, unused);
  }
};
TYPED_TEST_SUITE(ElementContract, GoogleTypes<ElementEnergies>::type);

double largest(const V& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TYPED_TEST(ElementContract, NothingAtRest) {
  using E = TypeParam;
  for (int k = 0; k < 20; ++k) {
    const auto rest = this->new_rest();
    V gradient[E::num_vertices];
    const double energy = E::energy_gradient(this->reference, rest, this->params, gradient);
    EXPECT_NEAR(E::zero_at_rest ? energy : 0, 0, 1e-10);
    for (const V& g : gradient) EXPECT_LT(largest(g), 2e-10);
  }
}

TYPED_TEST(ElementContract, NoNetForceNoNetTorque) {
  using E = TypeParam;
  for (int k = 0; k < 50; ++k) {
    const auto rest = this->new_rest();
    V x[E::num_vertices], gradient[E::num_vertices];
    testing::random_element(this->random, 0.4, x);
    E::energy_gradient(x, rest, this->params, gradient);
    V force{0, 0, 0}, torque{0, 0, 0};
    double size = 0;
    for (int i = 0; i < E::num_vertices; ++i) {
      force = force + gradient[i];
      torque = torque + cross(x[i], gradient[i]);
      size += norm(gradient[i]);
    }
    EXPECT_LT(largest(force), 1e-12 * size);
    EXPECT_LT(largest(torque), 1e-12 * size);
    EXPECT_GT(size, 1e-3) << "a test on zero forces proves nothing";
  }
}

TYPED_TEST(ElementContract, GradientEqualsCentralDifferences) {
  using E = TypeParam;
  const double h = 1e-5;
  for (int k = 0; k < 50; ++k) {
    const auto rest = this->new_rest();
    V x[E::num_vertices], gradient[E::num_vertices];
    for (int i = 0; i < E::num_vertices; ++i)
      x[i] = this->reference[i] + this->random.vector(testing::sample_displacement<E>);
    E::energy_gradient(x, rest, this->params, gradient);
    double size = 0;
    for (const V& g : gradient) size = std::max(size, largest(g));
    for (int i = 0; i < E::num_vertices; ++i) {
      for (double V::*axis : {&V::x, &V::y, &V::z}) {
        const double at = x[i].*axis;
        x[i].*axis = at + h;
        const double above = this->energy(x, rest);
        x[i].*axis = at - h;
        const double below = this->energy(x, rest);
        x[i].*axis = at;
        EXPECT_NEAR((above - below) / (2 * h), gradient[i].*axis, 1e-6 * size);
      }
    }
  }
}

TYPED_TEST(ElementContract, FeelsNoRigidMotion) {
  using E = TypeParam;
  for (int k = 0; k < 20; ++k) {
    const auto rest = this->new_rest();
    V x[E::num_vertices], y[E::num_vertices];
    testing::random_element(this->random, 0.3, x);
    const V axis = this->random.vector(1), shift = this->random.vector(30);
    const double angle = this->random(-3, 3);
    for (int i = 0; i < E::num_vertices; ++i) y[i] = testing::moved(x[i], axis, angle, shift);
    const double energy = this->energy(x, rest);
    EXPECT_NEAR(this->energy(y, rest), energy, 1e-11 * (1 + std::abs(energy)));
  }
}

TYPED_TEST(ElementContract, FiniteWhenCollapsed) {
  using E = TypeParam;
  const auto rest = this->new_rest();
  const V on_a_point[4] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  const V on_a_line[4] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  for (const auto& shape : {on_a_point, on_a_line}) {
    V x[E::num_vertices], gradient[E::num_vertices];
    for (int i = 0; i < E::num_vertices; ++i) x[i] = shape[i];
    EXPECT_TRUE(std::isfinite(E::energy_gradient(x, rest, this->params, gradient)));
    for (const V& g : gradient) EXPECT_TRUE(std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.z));
  }
}

TYPED_TEST(ElementContract, WeightIsPositiveSemidefiniteAndSteersDownhill) {
  using E = TypeParam;
  for (int k = 0; k < 20; ++k) {
    const auto rest = this->new_rest();
    double rows[2][E::num_vertices];
    const int num_rows = E::weight_rows(rest, this->params, rows);
    ASSERT_GE(num_rows, 1);
    for (int r = 0; r < num_rows; ++r) {
      double sum = 0, size = 0;
      for (int i = 0; i < E::num_vertices; ++i) {
        ASSERT_TRUE(std::isfinite(rows[r][i]));
        sum += rows[r][i];
        size += std::abs(rows[r][i]);
      }
      EXPECT_GT(size, 0);
      EXPECT_LT(std::abs(sum), 1e-12 * size) << "a weight must not resist a translation";
    }
  }
}

TYPED_TEST(ElementContract, FloatFollowsDouble) {
  using E = TypeParam;
  constexpr int corners = E::num_vertices;
  Vec3<float> rest_float[corners], x[corners], gradient_float[corners];
  V reference_double[corners], x_double[corners], gradient[corners];
  testing::random_element(this->random, 0.1, reference_double);
  for (int i = 0; i < corners; ++i) {
    const V step = this->random.vector(0.1);
    rest_float[i] = {float(reference_double[i].x), float(reference_double[i].y), float(reference_double[i].z)};
    x[i] = {float(reference_double[i].x + step.x), float(reference_double[i].y + step.y),
            float(reference_double[i].z + step.z)};
    reference_double[i] = {rest_float[i].x, rest_float[i].y, rest_float[i].z};
    x_double[i] = {x[i].x, x[i].y, x[i].z};
  }
  const auto p = this->params;
  typename E::template Params<float> params_float;
  static_assert(sizeof(p) == 2 * sizeof(params_float), "parameters are plain numbers");
  const double* from = reinterpret_cast<const double*>(&p);
  float* to = reinterpret_cast<float*>(&params_float);
  for (std::size_t i = 0; i < sizeof(p) / sizeof(double); ++i) to[i] = static_cast<float>(from[i]);
  E::energy_gradient(x_double, E::rest(reference_double, p), p, gradient);
  E::energy_gradient(x, E::rest(rest_float, params_float), params_float, gradient_float);
  double size = 0;
  for (const V& g : gradient) size = std::max(size, largest(g));
  for (int i = 0; i < corners; ++i) {
    EXPECT_NEAR(gradient_float[i].x, gradient[i].x, 1e-4 * size);
    EXPECT_NEAR(gradient_float[i].y, gradient[i].y, 1e-4 * size);
    EXPECT_NEAR(gradient_float[i].z, gradient[i].z, 1e-4 * size);
  }
}

}  // namespace
}  // namespace npfem
