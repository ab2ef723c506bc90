// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <string_view>

#include "model/model.h"

namespace npfem {

/// "volume" um3, "area" um2, "extent_x|y|z" um, "centre_x|y|z" um of a cell with the given flat positions (um).
/// Throws Error(unknown_name) for any other key.
double measure_shape(const Model& model, std::string_view key, std::span<const double> position);

/// "energy" (sum) or "energy:<name>", from energies in the order of Model::energy_names(), pN um.
double measure_energy(const Model& model, std::string_view key, std::span<const double> energies);

/// Throws Error(bad_input) when external forces (flat, pN) do not add up to zero: there is then no static equilibrium.
void require_balanced(std::span<const double> force, int cell);

}  // namespace npfem
