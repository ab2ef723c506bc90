// SPDX-License-Identifier: MPL-2.0
// What comes through the C interface, checked before it is used; and text on its way out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace npfem::capi {

/// Throws Error(bad_argument) naming the argument that is NULL.
void require_pointer(const void* pointer, const char* name);
std::string_view text_argument(const char* text, const char* name);

/// Throws Error(bad_argument) unless `length` >= 0 and the array is there; an empty array may be NULL.
void require_array(const void* array, std::int32_t length, const char* name);
void require_length(std::int32_t found, std::size_t needed, std::string_view what);

template <class T>
std::span<T> array_argument(T* array, std::int32_t length, const char* name) {
  require_array(array, length, name);
  return {array, static_cast<std::size_t>(length)};
}

/// Triples, one after the other: xyzxyz...
template <class T>
void copy_triples(const std::vector<std::array<T, 3>>& triples, std::span<T> out) {
  for (std::size_t i = 0; i < triples.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) out[3 * i + k] = triples[i][k];
  }
}

/// Throws Error(bad_argument) unless 0 <= index < count: `parameter 40 does not exist; there are 33`.
std::size_t require_index(std::int32_t index, std::size_t count, const char* what);

/// A count as the interface gives it.
std::int32_t as_count(std::size_t count);

/// The largest part of `text` within `capacity` bytes that does not end inside a UTF-8 character.
std::size_t whole_characters(std::string_view text, std::size_t capacity) noexcept;

/// Copies text with its final zero into the caller's buffer, cut where it does not fit; returns the uncut length.
/// Capacity 0 asks for the length alone.
std::int32_t text_out(std::string_view text, char* buffer, std::int32_t capacity);

}  // namespace npfem::capi
