// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace npfem {

/// What kind of thing went wrong. The numbers are part of the C ABI (npfem.h) and never change.
enum class Status : int {
  bad_argument = -1,  ///< null pointer, wrong size, out-of-range index
  bad_handle = -2,    ///< never created, already released, or of another kind
  bad_input = -3,     ///< a mesh, material or value that physics does not allow
  unknown_name = -4,  ///< key, field, preset, shape or back end that does not exist
  wrong_order = -5,   ///< a call that needs another one first
  io = -6,            ///< a file that cannot be read or written
  unavailable = -7,   ///< a back end this build does not have
  out_of_memory = -8,
  internal = -9,
};

/// An error that a caller can act on: what was found, where, what is allowed, what to do.
class Error : public std::runtime_error {
 public:
  Error(Status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  Status status() const { return status_; }

 private:
  Status status_;
};

}  // namespace npfem
