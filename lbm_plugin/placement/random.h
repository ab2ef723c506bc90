// SPDX-License-Identifier: MPL-2.0
// Random numbers that are the same on every machine: xoshiro256++ (Blackman & Vigna 2021), seeded by splitmix64.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "geometry/vec3.h"

namespace npfem::flow {

class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }

  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double least, double largest) { return least + (largest - least) * uniform(); }

  /// Every direction alike.
  Vec3 direction() {
    const double z = uniform(-1, 1);
    const double angle = 2 * std::numbers::pi * uniform();
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  /// Every orientation alike (Shoemake 1992).
  Rotation rotation() {
    const double u = uniform();
    const double a = 2 * std::numbers::pi * uniform();
    const double b = 2 * std::numbers::pi * uniform();
    const double p = std::sqrt(1 - u);
    const double q = std::sqrt(u);
    return rotation_of_quaternion(p * std::sin(a), p * std::cos(a), q * std::sin(b), q * std::cos(b));
  }

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace npfem::flow
