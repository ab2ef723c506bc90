// SPDX-License-Identifier: MPL-2.0
#pragma once

// Files in this folder are compiled once per instruction set, each time in a namespace of its own, and use no library
// templates: the linker keeps one of several functions of the same name, wherever it was compiled.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define NPFEM_ISA avx512
#elif defined(__AVX2__)
#define NPFEM_ISA avx2
#else
#define NPFEM_ISA baseline
#endif

#define NPFEM_INLINE [[gnu::always_inline]] inline
#define NPFEM_INLINE_LAMBDA __attribute__((always_inline))
