// SPDX-License-Identifier: MPL-2.0
#pragma once

// The physics of an energy is written once and runs wherever its caller runs: in a CUDA kernel, or inlined into a loop
// that was compiled for one instruction set. It must never be emitted as a function of its own, because the linker
// would then keep one copy for all instruction sets, and that copy may not run on the machine at hand.
#ifdef __CUDACC__
#define NPFEM_HD __host__ __device__ inline
#else
#define NPFEM_HD [[gnu::always_inline]] inline
#endif
