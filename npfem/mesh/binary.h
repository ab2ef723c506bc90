// SPDX-License-Identifier: MPL-2.0
// Little-endian numbers in a block of bytes, whatever the byte order of the machine.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace npfem {

template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 8, std::uint64_t,
    std::conditional_t<sizeof(T) == 4, std::uint32_t, std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

/// The number at the start of `bytes`, which must be long enough.
template <class T>
T load(std::string_view bytes) {
  BitsOf<T> bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const BitsOf<T> byte = static_cast<unsigned char>(bytes[i]);
    bits = static_cast<BitsOf<T>>(bits | static_cast<BitsOf<T>>(byte << (8 * i)));
  }
  return std::bit_cast<T>(bits);
}

template <class T>
void store(T value, std::string& bytes) {
  const auto bits = std::bit_cast<BitsOf<T>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>((bits >> (8 * i)) & 0xff);
}

}  // namespace npfem
