// SPDX-License-Identifier: MPL-2.0
// Every energy on a pack of two lanes that hold different shapes: each lane gets the bits of the same shape alone, so
// no energy chooses with an `if` or asks more of its number type than energies/number.h offers.
#include <gtest/gtest.h>

#include <cmath>

#include "energies/energy_list.h"
#include "random_shape.h"
#include "sample_params.h"

namespace npfem {
namespace testing {

struct Pair {
  double a = 0, b = 0;
  Pair() = default;
  explicit Pair(double both) : a(both), b(both) {}
  Pair(double first, double second) : a(first), b(second) {}
};
struct PairMask {
  bool a, b;
};

Pair operator-(Pair x) {
  return {-x.a, -x.b};
}
#define NPFEM_PAIR_OPERATOR(op)        \
  Pair operator op(Pair x, Pair y) {   \
    return {x.a op y.a, x.b op y.b};   \
  }                                    \
  Pair operator op(double x, Pair y) { \
    return {x op y.a, x op y.b};       \
  }                                    \
  Pair operator op(Pair x, double y) { \
    return {x.a op y, x.b op y};       \
  }
NPFEM_PAIR_OPERATOR(+)
NPFEM_PAIR_OPERATOR(-)
NPFEM_PAIR_OPERATOR(*)
NPFEM_PAIR_OPERATOR(/)
#undef NPFEM_PAIR_OPERATOR
PairMask operator<(Pair x, Pair y) {
  return {x.a < y.a, x.b < y.b};
}
PairMask operator>(Pair x, Pair y) {
  return {x.a > y.a, x.b > y.b};
}
Pair select(PairMask m, Pair yes, Pair no) {
  return {m.a ? yes.a : no.a, m.b ? yes.b : no.b};
}
Pair square_root(Pair x) {
  return {std::sqrt(x.a), std::sqrt(x.b)};
}

}  // namespace testing

namespace {

using testing::Pair;
using V = Vec3<double>;
using VPair = Vec3<Pair>;

template <class E, class T, int n>
T energy_of(const Vec3<T> (&x)[n], const typename E::template Rest<double>& rest,
            const typename E::template Params<double>& params, Vec3<T> (&gradient)[n]) {
  if constexpr (testing::is_group<E>) {
    return E::energy_gradient(x, n, rest, params, gradient);
  } else {
    return E::energy_gradient(x, rest, params, gradient);
  }
}

template <class E>
void compare_lanes() {
  constexpr int n = testing::sample_count<E>;
  testing::Random random(11);
  const auto params = testing::sample_params<E>();
  V shape[n], first[n], second[n], g_first[n], g_second[n];
  VPair both[n], g_both[n];
  testing::sample_shape<E>(random, 0.15, shape);
  const auto rest = [&] {
    if constexpr (testing::is_group<E>) {
      return E::rest(shape, n, params);
    } else {
      return E::rest(shape, params);
    }
  }();
  for (int k = 0; k < 20; ++k) {
    testing::sample_shape<E>(random, 0.3, first);
    testing::sample_shape<E>(random, 0.3, second);
    for (int i = 0; i < n; ++i) {
      first[i] = testing::sample_squeeze<E> * first[i];
      second[i] = testing::sample_squeeze<E> * second[i];
      both[i] = {{first[i].x, second[i].x}, {first[i].y, second[i].y}, {first[i].z, second[i].z}};
    }
    const Pair energy = energy_of<E>(both, rest, params, g_both);
    EXPECT_EQ(energy.a, energy_of<E>(first, rest, params, g_first)) << E::name;
    EXPECT_EQ(energy.b, energy_of<E>(second, rest, params, g_second)) << E::name;
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(g_both[i].x.a, g_first[i].x) << E::name;
      EXPECT_EQ(g_both[i].y.b, g_second[i].y) << E::name;
      EXPECT_EQ(g_both[i].z.a, g_first[i].z) << E::name;
    }
  }
}

TEST(Lanes, EachGetsTheBitsOfItsShapeAlone) {
  for_each_energy(ElementEnergies{}, [](auto tag) { compare_lanes<typename decltype(tag)::type>(); });
  for_each_energy(GroupEnergies{}, [](auto tag) { compare_lanes<typename decltype(tag)::type>(); });
}

}  // namespace
}  // namespace npfem
