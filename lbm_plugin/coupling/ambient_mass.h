// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "units.h"

namespace npfem::flow {

/// Thickness (um) of the layer of fluid that a membrane drags along when the forces on it change at once, over the time
/// `delta` (us) for which a force is held:
///   ell^2 = ell0^2 + pi nu delta.
/// ell0 is the numerical layer: one step moves a smooth force density on a surface by the mean of the squared weights
/// of the kernel, 1/ell0 (8/3, 2 and 1.28 node spacings for 4, 3 and 2 points). The second part is the impulsively
/// loaded viscous sheet, which moves at q sqrt(delta / (pi nu)) / rho under the traction q.
double ambient_layer(int kernel_points, const Units& units, double kinematic_viscosity, double delta);

/// ell0 in node spacings.
double kernel_layer(int kernel_points);

/// The mass of fluid (fg) that moves with each vertex of rest area A_i (um2): rho A_i ell, and where vertices are so
/// far apart that each acts alone (A_i > ell0^2), rho ell0^2 ell. With twice this mass the explicit exchange of force
/// and velocity between fluid and cell would become unstable for a stiff membrane; with this one it is stable for any.
std::vector<double> ambient_masses(std::span<const double> rest_areas, int kernel_points, const Units& units,
                                   double kinematic_viscosity, double delta);

}  // namespace npfem::flow
