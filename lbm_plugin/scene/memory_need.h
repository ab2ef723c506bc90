// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace npfem::flow {

/// How many nodes are fluid: counted, or, in a box too large for that, from the volume between the walls.
struct FluidNodes {
  std::int64_t count = 0;
  bool exact = true;
};
FluidNodes fluid_nodes(const Domain& domain);

/// Bytes that every process takes for one wall from an STL file: its distance at all nodes of the box.
double surface_memory(const Domain& domain);

/// Bytes that all processes of a run take together, roughly (docs/hpc.md); walls from STL files are beside it.
struct MemoryNeed {
  double fluid = 0;
  double cells = 0;
};
MemoryNeed memory_need(const Scene& scene, const FluidNodes& nodes, const std::vector<int>& cell_counts);

/// Bytes of memory of this machine.
double machine_memory();

/// text::InputError, naming the key to change, where the share of the run that is to lie on this machine does not fit
/// into its memory of so many bytes. Needs the types.
void require_memory(const Scene& scene, const std::vector<int>& cell_counts, double share, double memory);

}  // namespace npfem::flow
