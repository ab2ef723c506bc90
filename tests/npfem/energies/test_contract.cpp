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

template <class... Lists>
struct GoogleTypes;
template <class... Es, class... Gs>
struct GoogleTypes<TypeList<Es...>, TypeList<Gs...>> {
  using type = ::testing::Types<Es..., Gs...>;
};

// Elements and groups offer the same, groups with the number of vertices beside them.

template <class E, class T>
auto rest_of(const Vec3<T> (&x)[testing::sample_count<E>], const typename E::template Params<T>& params) {
  if constexpr (testing::is_group<E>) {
    return E::rest(x, testing::sample_count<E>, params);
  } else {
    return E::rest(x, params);
  }
}

template <class E, class T>
T energy_gradient(const Vec3<T> (&x)[testing::sample_count<E>], const typename E::template Rest<T>& rest,
                  const typename E::template Params<T>& params, Vec3<T> (&gradient)[testing::sample_count<E>]) {
  if constexpr (testing::is_group<E>) {
    return E::energy_gradient(x, testing::sample_count<E>, rest, params, gradient);
  } else {
    return E::energy_gradient(x, rest, params, gradient);
  }
}

template <class E>
std::vector<std::vector<double>> weight_rows(const typename E::template Rest<double>& rest,
                                             const typename E::template Params<double>& params) {
  std::vector<std::vector<double>> all;
  const auto collect = [&all](const auto& rows, int num_rows) {
    for (int r = 0; r < num_rows; ++r) all.emplace_back(rows[r], rows[r] + testing::sample_count<E>);
  };
  if constexpr (testing::is_group<E>) {
    double rows[E::max_vertices][E::max_vertices];
    collect(rows, E::weight_rows(rest, params, testing::sample_count<E>, rows));
  } else {
    double rows[max_weight_rows<E>][E::num_vertices];
    collect(rows, E::weight_rows(rest, params, rows));
  }
  return all;
}

/// An energy that holds vertices to places keeps the contract but for rigid motions.
template <class E>
constexpr bool is_held = [] {
  if constexpr (testing::is_group<E>) {
    return false;
  } else {
    return !is_translation_invariant_energy<E>;
  }
}();

template <class E>
class EnergyContract : public ::testing::Test {
 protected:
  static constexpr int n = testing::sample_count<E>;
  using Params = typename E::template Params<double>;
  using Rest = typename E::template Rest<double>;

  const Params params = testing::sample_params<E>();
  V reference[n];
  Random random{7};

  Rest new_rest() {
    testing::sample_shape<E>(random, 0.15, reference);
    return rest_of<E>(reference, params);
  }
  double energy(const V (&x)[n], const Rest& rest) const {
    V unused[n];
    return energy_gradient<E>(x, rest, params, unused);
  }
};
using AllEnergies = GoogleTypes<ElementEnergies, GroupEnergies>::type;
TYPED_TEST_SUITE(EnergyContract, AllEnergies);

/// A deformed shape that the energy answers to.
template <class E>
void sample_squeezed(Random& random, double noise, V (&x)[testing::sample_count<E>]) {
  testing::sample_shape<E>(random, noise, x);
  for (V& vertex : x) vertex = testing::sample_squeeze<E> * vertex;
}

double largest(const V& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TYPED_TEST(EnergyContract, NothingAtRest) {
  using E = TypeParam;
  for (int k = 0; k < 20; ++k) {
    const auto rest = this->new_rest();
    V gradient[TestFixture::n];
    double energy = energy_gradient<E>(this->reference, rest, this->params, gradient);
    if constexpr (testing::fits_a_shape<E>) {
      // At rest is where the energy leads to: half of the way to the nearest such shape, often enough.
      EXPECT_GT(energy, 1e-6) << "the test starts away from rest";
      for (int step = 0; step < 100; ++step) {
        for (int i = 0; i < TestFixture::n; ++i) {
          this->reference[i] = this->reference[i] - (0.5 / this->params.weight) * gradient[i];
        }
        energy = energy_gradient<E>(this->reference, rest, this->params, gradient);
      }
    }
    EXPECT_NEAR(E::zero_at_rest || testing::fits_a_shape<E> ? energy : 0, 0, 1e-10);
    for (const V& g : gradient) EXPECT_LT(largest(g), 2e-10);
  }
}

TYPED_TEST(EnergyContract, NoNetForceNoNetTorque) {
  using E = TypeParam;
  if (is_held<E>) return;
  for (int k = 0; k < 50; ++k) {
    const auto rest = this->new_rest();
    V x[TestFixture::n], gradient[TestFixture::n];
    sample_squeezed<E>(this->random, 0.4, x);
    energy_gradient<E>(x, rest, this->params, gradient);
    V force{0, 0, 0}, torque{0, 0, 0};
    double size = 0;
    for (int i = 0; i < TestFixture::n; ++i) {
      force = force + gradient[i];
      torque = torque + cross(x[i], gradient[i]);
      size += norm(gradient[i]);
    }
    EXPECT_LT(largest(force), 1e-12 * size);
    EXPECT_LT(largest(torque), 1e-12 * size);
    EXPECT_GT(size, 1e-3) << "a test on zero forces proves nothing";
  }
}

TYPED_TEST(EnergyContract, GradientEqualsCentralDifferences) {
  using E = TypeParam;
  const double h = 1e-5;
  for (int k = 0; k < 50; ++k) {
    const auto rest = this->new_rest();
    V x[TestFixture::n], gradient[TestFixture::n];
    for (int i = 0; i < TestFixture::n; ++i)
      x[i] = testing::sample_squeeze<E> * this->reference[i] + this->random.vector(testing::sample_displacement<E>);
    energy_gradient<E>(x, rest, this->params, gradient);
    double size = 0;
    for (const V& g : gradient) size = std::max(size, largest(g));
    for (int i = 0; i < TestFixture::n; ++i) {
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

TYPED_TEST(EnergyContract, FeelsNoRigidMotion) {
  using E = TypeParam;
  if (is_held<E>) return;
  for (int k = 0; k < 20; ++k) {
    const auto rest = this->new_rest();
    V x[TestFixture::n], y[TestFixture::n];
    sample_squeezed<E>(this->random, 0.3, x);
    const V axis = this->random.vector(1), shift = this->random.vector(30);
    const double angle = this->random(-3, 3);
    for (int i = 0; i < TestFixture::n; ++i) y[i] = testing::moved(x[i], axis, angle, shift);
    const double energy = this->energy(x, rest);
    EXPECT_NEAR(this->energy(y, rest), energy, 1e-11 * (1 + std::abs(energy)));
  }
}

TYPED_TEST(EnergyContract, FiniteWhenCollapsed) {
  using E = TypeParam;
  const auto rest = this->new_rest();
  for (const V& spacing : {V{0, 0, 0}, V{1, 0, 0}}) {  // on a point, on a line
    V x[TestFixture::n], gradient[TestFixture::n];
    for (int i = 0; i < TestFixture::n; ++i) x[i] = V{1, 2, 3} + static_cast<double>(i) * spacing;
    EXPECT_TRUE(std::isfinite(energy_gradient<E>(x, rest, this->params, gradient)));
    for (const V& g : gradient) EXPECT_TRUE(std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.z));
  }
}

TYPED_TEST(EnergyContract, WeightIsPositiveSemidefiniteAndBlindToTranslations) {
  using E = TypeParam;
  for (int k = 0; k < 20; ++k) {
    const auto rows = weight_rows<E>(this->new_rest(), this->params);
    ASSERT_FALSE(rows.empty());
    for (const std::vector<double>& row : rows) {  // a sum of squares cannot be negative
      double sum = 0, size = 0;
      for (const double entry : row) {
        ASSERT_TRUE(std::isfinite(entry));
        sum += entry;
        size += std::abs(entry);
      }
      EXPECT_EQ(size > 0, testing::sample_squeeze<E> == 1) << "what acts on squeezed shapes only has no weight";
      EXPECT_LT(is_held<E> ? 0 : std::abs(sum), 1e-12 * size + 1e-300) << "a weight must not resist a translation";
    }
  }
}

TYPED_TEST(EnergyContract, FloatFollowsDouble) {
  using E = TypeParam;
  constexpr int corners = TestFixture::n;
  Vec3<float> rest_float[corners], x[corners], gradient_float[corners];
  V reference_double[corners], x_double[corners], gradient[corners];
  testing::sample_shape<E>(this->random, 0.1, reference_double);
  for (int i = 0; i < corners; ++i) {
    const V step =
        (testing::sample_squeeze<E> - 1) * reference_double[i] + testing::sample_squeeze<E> * this->random.vector(0.1);
    rest_float[i] = {float(reference_double[i].x), float(reference_double[i].y), float(reference_double[i].z)};
    x[i] = {float(reference_double[i].x + step.x), float(reference_double[i].y + step.y),
            float(reference_double[i].z + step.z)};
    reference_double[i] = {rest_float[i].x, rest_float[i].y, rest_float[i].z};
    x_double[i] = {x[i].x, x[i].y, x[i].z};
  }
  const auto p = this->params;
  typename E::template Params<float> params_float;
  static_assert(sizeof(p) == 2 * sizeof(params_float), "parameters are plain numbers");
  static_assert(sizeof(typename E::template Rest<double>) == 2 * sizeof(typename E::template Rest<float>),
                "a rest shape is plain numbers");
  const double* from = reinterpret_cast<const double*>(&p);
  float* to = reinterpret_cast<float*>(&params_float);
  for (std::size_t i = 0; i < sizeof(p) / sizeof(double); ++i) to[i] = static_cast<float>(from[i]);
  energy_gradient<E>(x_double, rest_of<E>(reference_double, p), p, gradient);
  energy_gradient<E>(x, rest_of<E>(rest_float, params_float), params_float, gradient_float);
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
