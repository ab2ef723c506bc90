// SPDX-License-Identifier: MPL-2.0
// In place of vtkhdf.cpp where HDF5 is not installed.
#include <stdexcept>

#include "output/vtkhdf.h"

namespace npfem::flow {
namespace {

[[noreturn]] void refuse() {
  throw std::logic_error("this build has no HDF5");
}

}  // namespace

bool has_vtkhdf() {
  return false;
}
void append_cells(Communicator&, const std::filesystem::path&, double, const CellArrays&) {
  refuse();
}
void append_fluid(Communicator&, const std::filesystem::path&, double, const FluidArrays&) {
  refuse();
}
bool cut_vtkhdf(const std::filesystem::path&, double) {
  return false;
}

}  // namespace npfem::flow
