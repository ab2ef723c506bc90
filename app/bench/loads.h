// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

namespace npfem::app::bench {

// External forces (xyzxyz..., pN) that balance and are smooth over the surface, so that they mean the same on every
// mesh. `x`: positions (um), `area`: per vertex (um^2), `force`: sum on either side (pN).

/// Pulls the two ends apart along x: in proportion to area and x^3.
std::vector<double> stretching_loads(std::span<const double> x, std::span<const double> area, double force);
/// Shears in the plane of the cell: along x, in proportion to area and y.
std::vector<double> shearing_loads(std::span<const double> x, std::span<const double> area, double force);

}  // namespace npfem::app::bench
