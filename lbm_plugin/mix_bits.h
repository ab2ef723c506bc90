// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>

namespace npfem::flow {

/// Every bit of the input reaches every bit of the output: the finaliser of splitmix64 (Steele, Lea & Flood 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace npfem::flow
