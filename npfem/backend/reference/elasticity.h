// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "backend/reference/vertex_field.h"
#include "model/model.h"

namespace npfem {

/// Elastic energy (pN um) of one cell at positions x (um); adds dE/dx (pN) to `gradient`. Where `by_energy` is given it
/// receives the single energies in the order of Model::energy_names().
double elastic_energy(const Model& model, const VertexField& x, VertexField& gradient,
                      std::span<double> by_energy = {});

/// Area, volume and sum |dV/dx|^2 of the cell's surface; writes dA/dx and dV/dx.
CellSums<double> surface_sums(const Model& model, const VertexField& x, VertexField& area_gradient,
                              VertexField& volume_gradient);

}  // namespace npfem
