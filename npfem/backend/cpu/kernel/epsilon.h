// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/isa.h"

namespace npfem::NPFEM_ISA {

/// Spacing of the numbers next to one.
template <class R>
inline constexpr R epsilon = sizeof(R) == 8 ? R(2.220446049250313e-16) : R(1.1920929e-7f);

}  // namespace npfem::NPFEM_ISA
