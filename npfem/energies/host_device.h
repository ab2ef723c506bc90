// SPDX-License-Identifier: MPL-2.0
#pragma once

// The physics of an energy is written once and runs wherever its caller runs.
#ifdef __CUDACC__
#define NPFEM_HD __host__ __device__
#else
#define NPFEM_HD
#endif
