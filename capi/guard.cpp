// SPDX-License-Identifier: MPL-2.0
#include "guard.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <stdexcept>

#include "arguments.h"
#include "error.h"
#include "file.h"
#include "quantity.h"

namespace npfem::capi {
namespace {

/// One thread's last message.
class Message {
 public:
  void clear() noexcept { size_ = 0; }
  void append(std::string_view text) noexcept {
    const std::size_t kept = whole_characters(text, text_.size() - size_);
    std::copy_n(text.data(), kept, text_.data() + size_);
    size_ += kept;
  }
  std::string_view view() const noexcept { return {text_.data(), size_}; }

 private:
  std::array<char, 2048> text_{};
  std::size_t size_ = 0;
};

thread_local Message message;

}  // namespace

std::int32_t fail(std::int32_t status, const char* function, std::string_view what) noexcept {
  message.clear();
  message.append(function);
  message.append(": ");
  message.append(what);
  return status;
}

std::int32_t fail_with_current_exception(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& e) {
    return fail(static_cast<std::int32_t>(e.status()), function, e.what());
  } catch (const text::FileError& e) {
    return fail(NPFEM_ERROR_IO, function, e.what());
  } catch (const text::InputError& e) {
    return fail(NPFEM_ERROR_INPUT, function, e.what());
  } catch (const std::bad_alloc&) {
    return fail(NPFEM_ERROR_MEMORY, function, "out of memory");
  } catch (const std::length_error&) {
    return fail(NPFEM_ERROR_MEMORY, function, "out of memory: the size asked for is beyond what can be addressed");
  } catch (const std::exception& e) {
    return fail(NPFEM_ERROR_INTERNAL, function, e.what());
  } catch (...) {
    return fail(NPFEM_ERROR_INTERNAL, function, "unknown exception");
  }
}

std::string_view last_error() noexcept {
  return message.view();
}

}  // namespace npfem::capi
