// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace npfem::flow {

/// The steady flow along a channel of the same section everywhere: the solution of Poisson's equation with a constant
/// source, zero on walls half-way between a fluid node and a node that is none. Exact for plates.
struct SectionFlow {
  std::vector<double> profile;  ///< share of the mean velocity at each node, 0 where there is no fluid
  std::size_t nodes;            ///< of the fluid
  double mean;  ///< velocity times viscosity over pressure gradient, in squares of the spacing; infinite without walls
  double steepest;  ///< largest slope of the profile, per spacing
};

/// `fluid` by node, index u + counts[0] v.
SectionFlow section_flow(const std::vector<bool>& fluid, const std::array<int, 2>& counts,
                         const std::array<bool, 2>& periodic);

}  // namespace npfem::flow
