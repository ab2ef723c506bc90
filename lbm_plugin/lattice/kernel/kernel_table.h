// SPDX-License-Identifier: MPL-2.0
#pragma once

// The kernels of one instruction set; the function that returns them is the only thing other files see.

#include "lattice/kernel/collide.h"
#include "lattice/kernel/find_velocity.h"

namespace npfem::flow::NPFEM_ISA {

template <class Real>
constexpr Kernels<Real> kernel_table = {&collide<Real>, &find_velocity<Real>};

const Kernels<double>& double_kernels() {
  return kernel_table<double>;
}
const Kernels<float>& float_kernels() {
  return kernel_table<float>;
}

}  // namespace npfem::flow::NPFEM_ISA
