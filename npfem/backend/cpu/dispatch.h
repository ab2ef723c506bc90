// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backend/cpu/step_task.h"

namespace npfem::cpu {

/// Names of the instruction sets in this build that the machine at hand runs, the best first; "baseline" is always one.
std::vector<std::string> instruction_sets();

/// By name, or null where the build or the machine has no such one.
const KernelTable* kernels(std::string_view instruction_set);

}  // namespace npfem::cpu
