// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>

#include "communicator/communicator.h"

namespace npfem::flow {

/// The back end of the cell solver that all ranks use, by its full name. The bits of a cell depend on the instruction
/// set, and the machines of a group may differ: "cpu" becomes the best set that every rank has, "cpu-avx2" for example.
/// Any other name stays what it is. Collective; std::invalid_argument on every rank where a rank does not have it.
std::string agreed_backend(Communicator& communicator, const std::string& wanted);

}  // namespace npfem::flow
