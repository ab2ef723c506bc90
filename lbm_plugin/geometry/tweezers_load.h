// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

namespace npfem::flow {

/// Forces (xyz of every vertex, pN) of two beads that pull a cell apart along x: `force` on either side, shared equally
/// by the vertices of the two ends that lie within half of `contact_width` (um) of the line along x through its middle.
/// Their sum is zero to the last bit that rounding leaves. Empty where no vertex lies there at one of the ends.
std::vector<double> tweezers_load(std::span<const double> shape, double force, double contact_width);

}  // namespace npfem::flow
