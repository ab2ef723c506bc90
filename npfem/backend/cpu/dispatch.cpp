// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/dispatch.h"

namespace npfem {

namespace baseline {
extern const cpu::KernelTable table;
}
#ifdef NPFEM_X86_KERNELS
namespace avx2 {
extern const cpu::KernelTable table;
}
namespace avx512 {
extern const cpu::KernelTable table;
}
#endif

namespace cpu {
namespace {

struct Candidate {
  const KernelTable* table;
  bool runs;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
#ifdef NPFEM_X86_KERNELS
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  all.push_back({&avx512::table, has_avx512 && has_avx2});
  all.push_back({&avx2::table, has_avx2});
#endif
  all.push_back({&baseline::table, true});
  return all;
}

}  // namespace

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Candidate& candidate : candidates()) {
    if (candidate.runs) names.emplace_back(candidate.table->name);
  }
  return names;
}

const KernelTable* kernels(std::string_view instruction_set) {
  for (const Candidate& candidate : candidates()) {
    if (candidate.runs && instruction_set == candidate.table->name) return candidate.table;
  }
  return nullptr;
}

}  // namespace cpu
}  // namespace npfem
