// SPDX-License-Identifier: MPL-2.0
#include "arguments.h"

#include <algorithm>
#include <limits>

#include "error.h"

namespace npfem::capi {

void require_pointer(const void* pointer, const char* name) {
  if (!pointer) throw Error(Status::bad_argument, std::string(name) + " is NULL");
}

std::string_view text_argument(const char* text, const char* name) {
  require_pointer(text, name);
  return text;
}

void require_array(const void* array, std::int32_t length, const char* name) {
  if (length < 0) {
    throw Error(Status::bad_argument,
                "the length of " + std::string(name) + " is " + std::to_string(length) + "; allowed: 0 or more");
  }
  if (length > 0) require_pointer(array, name);
}

void require_length(std::int32_t found, std::size_t needed, std::string_view what) {
  if (found < 0 || static_cast<std::size_t>(found) != needed) {
    throw Error(Status::bad_argument, std::string(what) + " needs an array of " + std::to_string(needed) +
                                          " numbers, found " + std::to_string(found));
  }
}

std::size_t require_index(std::int32_t index, std::size_t count, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= count) {
    throw Error(Status::bad_argument, std::string(what) + " " + std::to_string(index) + " does not exist; there are " +
                                          std::to_string(count) + ", from 0");
  }
  return static_cast<std::size_t>(index);
}

std::int32_t as_count(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw Error(Status::internal, std::to_string(count) + " does not fit into an int32");
  }
  return static_cast<std::int32_t>(count);
}

std::size_t whole_characters(std::string_view text, std::size_t capacity) noexcept {
  if (text.size() <= capacity) return text.size();
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0u) == 0x80u; };
  std::size_t size = capacity;
  while (size > 0 && continues(size)) --size;
  return size;
}

std::int32_t text_out(std::string_view text, char* buffer, std::int32_t capacity) {
  if (capacity < 0) {
    throw Error(Status::bad_argument, "capacity is " + std::to_string(capacity) + "; allowed: 0 or more");
  }
  const std::int32_t length = as_count(text.size());
  if (capacity == 0) return length;
  require_pointer(buffer, "buffer");
  const std::size_t kept = whole_characters(text, static_cast<std::size_t>(capacity) - 1);
  std::copy_n(text.data(), kept, buffer);
  buffer[kept] = '\0';
  return length;
}

}  // namespace npfem::capi
