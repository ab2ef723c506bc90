// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>

namespace npfem::app::bench {

/// What one core can do at most: independent multiply-adds in registers, in the widest instruction set that the machine
/// and the cell solver share. A multiply-add counts two.
struct FmaPeak {
  std::string instruction_set;  ///< "avx512", "avx2" or "baseline"
  double double_gflops, float_gflops;
};

/// Takes about 0.2 s; the best of several tries, because a busy machine only ever makes it slower.
FmaPeak measure_fma_peak();

}  // namespace npfem::app::bench
