// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "batch/batch.h"
#include "mesh/generate.h"
#include "model/build_model.h"

namespace npfem::testing {

/// A red cell of level 2 (66 vertices) or more, of the shipped material with `density` (fg/um2) on its membrane.
inline std::shared_ptr<const Model> red_cell_model(int level = 2, double density = 0) {
  Material material = Material::preset("rbc");
  material.set("membrane_density", density);
  return std::make_shared<const Model>(build_model(evans_fung_cell(level), material));
}

inline std::vector<double> get(const Batch& batch, Field field, int cell = 0) {
  std::vector<double> values(static_cast<std::size_t>(components(field) * batch.model().num_vertices()));
  batch.read(field, cell, 1, values);
  return values;
}

/// The same vector at every vertex.
inline std::vector<double> uniform(const Model& model, double x, double y, double z) {
  std::vector<double> values;
  for (int i = 0; i < model.num_vertices(); ++i) values.insert(values.end(), {x, y, z});
  return values;
}

/// Mass (fg) of a fluid layer 1 um thick at every vertex, as a coupled fluid gives it.
inline std::vector<double> fluid_mass(const Model& model) {
  std::vector<double> mass;
  for (const double area : model.vertex_area) mass.push_back(1000 * area);
  return mass;
}

/// Ambient velocity of a simple shear u_x = rate * z (rate in 1/us).
inline std::vector<double> shear(const std::vector<double>& position, double rate) {
  std::vector<double> u(position.size(), 0.0);
  for (std::size_t i = 0; i < position.size(); i += 3) u[i] = rate * position[i + 2];
  return u;
}

/// Sum over vertices along each axis.
inline std::vector<double> total(const std::vector<double>& field) {
  std::vector<double> sum(3, 0.0);
  for (std::size_t i = 0; i < field.size(); ++i) sum[i % 3] += field[i];
  return sum;
}

}  // namespace npfem::testing
