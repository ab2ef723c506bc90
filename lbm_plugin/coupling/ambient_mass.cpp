// SPDX-License-Identifier: MPL-2.0
#include "coupling/ambient_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace npfem::flow {

double kernel_layer(int kernel_points) {
  switch (kernel_points) {
    case 2:
      return 1.28;
    case 3:
      return 2.0;
    default:
      return 8.0 / 3.0;
  }
}

double ambient_layer(int kernel_points, const Units& units, double kinematic_viscosity, double delta) {
  const double numerical = kernel_layer(kernel_points) * units.dx;
  return std::sqrt(numerical * numerical + std::numbers::pi * kinematic_viscosity * delta);
}

std::vector<double> ambient_masses(std::span<const double> rest_areas, int kernel_points, const Units& units,
                                   double kinematic_viscosity, double delta) {
  const double numerical = kernel_layer(kernel_points) * units.dx;
  const double layer = ambient_layer(kernel_points, units, kinematic_viscosity, delta);
  std::vector<double> masses;
  masses.reserve(rest_areas.size());
  for (const double area : rest_areas) {
    masses.push_back(units.density * std::min(area, numerical * numerical) * layer);
  }
  return masses;
}

}  // namespace npfem::flow
