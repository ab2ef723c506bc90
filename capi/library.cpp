// SPDX-License-Identifier: MPL-2.0
// The library as a whole: version, messages, release.
#include <array>
#include <string>

#include "arguments.h"
#include "backend/backend.h"
#include "error.h"
#include "guard.h"
#include "handle_table.h"
#include "npfem/npfem.h"

namespace npfem::capi {
namespace {

constexpr std::int32_t abi_version = 1;

/// In the order of their numbers, 0, -1, -2...
constexpr std::array<const char*, 10> status_names{
    "NPFEM_OK",           "NPFEM_ERROR_ARGUMENT", "NPFEM_ERROR_HANDLE", "NPFEM_ERROR_INPUT",
    "NPFEM_ERROR_NAME",   "NPFEM_ERROR_ORDER",    "NPFEM_ERROR_IO",     "NPFEM_ERROR_UNAVAILABLE",
    "NPFEM_ERROR_MEMORY", "NPFEM_ERROR_INTERNAL"};

const char* status_name(std::int32_t status) {
  constexpr auto count = static_cast<std::int32_t>(status_names.size());
  if (status > 0 || status <= -count) {
    throw Error(Status::bad_argument, "status " + std::to_string(status) +
                                          " does not exist; allowed: " + std::to_string(1 - count) + " to 0");
  }
  return status_names[static_cast<std::size_t>(-status)];
}

std::string build_info() {
  std::string backends;
  for (const std::string& name : backend_names()) backends += (backends.empty() ? "\"" : ", \"") + name + "\"";
  return R"({"version": ")" NPFEM_VERSION R"(", "abi_version": )" + std::to_string(abi_version) +
         R"(, "compiler": ")" NPFEM_COMPILER R"(", "backends": [)" + backends + "]}";
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem::capi;

int32_t npfem_abi_version(void) {
  return abi_version;
}

int32_t npfem_version(char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(NPFEM_VERSION, buffer, capacity); });
}

int32_t npfem_build_info(char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(build_info(), buffer, capacity); });
}

int32_t npfem_last_error(char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(last_error(), buffer, capacity); });
}

int32_t npfem_status_name(int32_t status, char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(status_name(status), buffer, capacity); });
}

int32_t npfem_release(int32_t handle) {
  return guard(__func__, [&] { handles().release(handle); });
}
