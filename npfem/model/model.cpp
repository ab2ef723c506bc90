// SPDX-License-Identifier: MPL-2.0
#include "model/model.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "mesh/geometry.h"
#include "model/model_parts.h"

namespace npfem {

bool Model::has_cell_terms() const {
  bool any = false;
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    any = any || cell_term<E>(*this).has_value();
  });
  return any;
}

bool Model::is_translation_invariant() const {
  bool invariant = true;
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (block<E>().size() > 0) invariant = invariant && is_translation_invariant_energy<E>;
  });
  return invariant;
}

bool Model::has_potential() const {
  bool potential = true;
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    potential = potential && (E::exact_gradient || !cell_term<E>(*this));
  });
  return potential;
}

std::vector<std::string> Model::energy_names() const {
  std::vector<std::string> names;
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (block<E>().size() > 0) names.emplace_back(E::name);
  });
  for_each_energy(GroupEnergies{}, [&](auto tag) {
    using G = typename decltype(tag)::type;
    if (group_block<G>().size() > 0) names.emplace_back(G::name);
  });
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (cell_term<E>(*this)) names.emplace_back(E::name);
  });
  return names;
}

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

Eigen::SparseMatrix<double> assembled(const Model& model, const Entries& entries) {
  Eigen::SparseMatrix<double> matrix(model.num_vertices(), model.num_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void require_finite(std::span<const double> row, const char* energy, std::size_t element) {
  if (std::all_of(row.begin(), row.end(), [](double entry) { return std::isfinite(entry * entry); })) return;
  throw Error(Status::bad_input, "energy " + std::string(energy) + ", element " + std::to_string(element) +
                                     ": its weight in the matrix of the solver is not finite: needed are a rest shape "
                                     "of positive area and a finite modulus of at least 0");
}

/// Adds row row^T, the row being given over some vertices.
void add_square(std::span<const double> row, std::span<const int> vertices, Entries& entries) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t j = 0; j < vertices.size(); ++j) entries.emplace_back(vertices[i], vertices[j], row[i] * row[j]);
  }
}

template <class E>
void add_element_weights(const ElementBlock<E>& block, Entries& entries) {
  for (std::size_t e = 0; e < block.size(); ++e) {
    double rows[max_weight_rows<E>][E::num_vertices];
    const int num_rows = E::weight_rows(block.rest[e], block.params[e], rows);
    for (int r = 0; r < num_rows; ++r) {
      require_finite(rows[r], E::name, e);
      add_square(rows[r], block.vertices[e], entries);
    }
  }
}

template <class G>
void add_group_weights(const GroupBlock<G>& block, Entries& entries) {
  for (std::size_t g = 0; g < block.size(); ++g) {
    const std::span<const int> group = block.group(g);
    double rows[G::max_vertices][G::max_vertices];
    const int num_rows = G::weight_rows(block.rest[g], block.params[g], static_cast<int>(group.size()), rows);
    for (int r = 0; r < num_rows; ++r) {
      require_finite({rows[r], group.size()}, G::name, g);
      add_square({rows[r], group.size()}, group, entries);
    }
  }
}

Eigen::SparseMatrix<double> assemble_weight(const Model& model) {
  Entries entries;
  for_each_energy(ElementEnergies{},
                  [&](auto tag) { add_element_weights(model.block<typename decltype(tag)::type>(), entries); });
  for_each_energy(GroupEnergies{},
                  [&](auto tag) { add_group_weights(model.group_block<typename decltype(tag)::type>(), entries); });
  return assembled(model, entries);
}

/// Viscosity acts between one step and the next; the initial shape stands for all of them.
Eigen::SparseMatrix<double> assemble_viscous_weight(const Model& model) {
  Entries entries;
  const double stiffness = MembraneViscosity::stiffness(model.viscosity);
  for (const Triangle& t : model.triangles) {
    if (!model.is_viscous()) break;
    Vec3<double> x[3];
    for (std::size_t i = 0; i < 3; ++i) x[i] = as_vec3(model.initial[static_cast<std::size_t>(t[i])]);
    double rows[2][3];
    const int num_rows = laplacian_rows(triangle_rest(x), stiffness, rows);
    for (int r = 0; r < num_rows; ++r) add_square(rows[r], t, entries);
  }
  return assembled(model, entries);
}

}  // namespace

void complete_model(Model& model) {
  const TriangleMesh surface{model.initial, model.triangles};
  model.vertex_area = vertex_areas(surface);
  model.rest = {surface_area(surface), signed_volume(surface)};
  model.weight = assemble_weight(model);
  model.viscous_weight = assemble_viscous_weight(model);
}

}  // namespace npfem
