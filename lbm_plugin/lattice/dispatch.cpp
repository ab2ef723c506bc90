// SPDX-License-Identifier: MPL-2.0
#include <type_traits>

#include "lattice/kernels.h"

namespace npfem::flow {

namespace baseline {
const Kernels<double>& double_kernels();
const Kernels<float>& float_kernels();
}  // namespace baseline
#ifdef NPFEM_X86_KERNELS
namespace avx2 {
const Kernels<double>& double_kernels();
const Kernels<float>& float_kernels();
}  // namespace avx2
namespace avx512 {
const Kernels<double>& double_kernels();
const Kernels<float>& float_kernels();
}  // namespace avx512
#endif

InstructionSet best_instruction_set() {
#ifdef NPFEM_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return InstructionSet::avx512;
  }
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

namespace {

template <class Real>
const Kernels<Real>& choose(const Kernels<double>& of_double, const Kernels<float>& of_float) {
  if constexpr (std::is_same_v<Real, double>) {
    return of_double;
  } else {
    return of_float;
  }
}

}  // namespace

template <class Real>
const Kernels<Real>& kernels(InstructionSet instruction_set) {
#ifdef NPFEM_X86_KERNELS
  switch (instruction_set) {
    case InstructionSet::avx512:
      return choose<Real>(avx512::double_kernels(), avx512::float_kernels());
    case InstructionSet::avx2:
      return choose<Real>(avx2::double_kernels(), avx2::float_kernels());
    case InstructionSet::baseline:
      break;
  }
#endif
  return choose<Real>(baseline::double_kernels(), baseline::float_kernels());
}

template const Kernels<double>& kernels<double>(InstructionSet);
template const Kernels<float>& kernels<float>(InstructionSet);

}  // namespace npfem::flow
