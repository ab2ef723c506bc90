// SPDX-License-Identifier: MPL-2.0
// The border between C++ and C: no exception crosses it, and every failure leaves a status and a message.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "npfem/npfem.h"

namespace npfem::capi {

/// Keeps "function: message" as this thread's last error and returns `status`. Never throws: the buffer is fixed, and
/// what does not fit is cut.
std::int32_t fail(std::int32_t status, const char* function, std::string_view message) noexcept;

/// fail() for the exception that is being handled.
std::int32_t fail_with_current_exception(const char* function) noexcept;

/// The message of the last failed call of this thread.
std::string_view last_error() noexcept;

/// Runs the body of the C function `function`: its result, NPFEM_OK where it has none, or the status of its failure.
template <class Body>
std::int32_t guard(const char* function, Body&& body) noexcept {
  try {
    if constexpr (std::is_void_v<decltype(body())>) {
      body();
      return NPFEM_OK;
    } else {
      return body();
    }
  } catch (...) {
    return fail_with_current_exception(function);
  }
}

}  // namespace npfem::capi
