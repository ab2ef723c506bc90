// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace npfem {

/// Spreads every bit of the input over all bits of the output (the finaliser of SplitMix64, Steele et al. 2014).
inline std::uint64_t mix_bits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

/// Hash of the bits of a sequence of numbers, continued from `seed`: equal bits, equal hash.
inline std::uint64_t hash_values(std::span<const double> values, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (const double value : values) hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(value));
  return hash;
}

}  // namespace npfem
