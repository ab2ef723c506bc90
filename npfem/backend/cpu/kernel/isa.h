// SPDX-License-Identifier: MPL-2.0
#pragma once

// What the compiler was told to compile this file for decides the name and the width of the registers.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define NPFEM_ISA avx512
#define NPFEM_ISA_NAME "avx512"
#define NPFEM_REGISTER_BYTES 64
#elif defined(__AVX2__) && defined(__FMA__)
#define NPFEM_ISA avx2
#define NPFEM_ISA_NAME "avx2"
#define NPFEM_REGISTER_BYTES 32
#else
#define NPFEM_ISA baseline
#define NPFEM_ISA_NAME "baseline"
#define NPFEM_REGISTER_BYTES 16
#endif

namespace npfem::NPFEM_ISA {

/// Lanes of one register for numbers of type R.
template <class R>
inline constexpr int lanes_of = NPFEM_REGISTER_BYTES / static_cast<int>(sizeof(R));

}  // namespace npfem::NPFEM_ISA
