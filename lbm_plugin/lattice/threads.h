// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem::flow {

/// Threads that each lattice of this process uses from now on; 1 where the build has no OpenMP. Not the results, only
/// the speed depends on it: more threads than free cores make a run many times slower.
void set_lattice_threads(int threads);

}  // namespace npfem::flow
