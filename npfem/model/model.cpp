// SPDX-License-Identifier: MPL-2.0
#include "model/model.h"

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

std::vector<std::string> Model::energy_names() const {
  std::vector<std::string> names;
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (block<E>().size() > 0) names.emplace_back(E::name);
  });
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (cell_term<E>(*this)) names.emplace_back(E::name);
  });
  return names;
}

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

/// Adds sum r r^T of one element.
template <std::size_t N>
void add_rows(Entries& entries, const std::array<int, N>& vertices, const double (&rows)[2][N], int num_rows) {
  for (int r = 0; r < num_rows; ++r) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) entries.emplace_back(vertices[i], vertices[j], rows[r][i] * rows[r][j]);
    }
  }
}

[[noreturn]] void refuse_weight(const char* energy, std::size_t element) {
  throw Error(Status::bad_input, "energy " + std::string(energy) + ", element " + std::to_string(element) +
                                     ": its weight in the matrix of the solver is not finite: needed are a rest shape "
                                     "of positive area and a finite modulus of at least 0");
}

Eigen::SparseMatrix<double> assembled(const Model& model, const Entries& entries) {
  Eigen::SparseMatrix<double> matrix(model.num_vertices(), model.num_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::SparseMatrix<double> assemble_weight(const Model& model) {
  Entries entries;
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    const auto& block = model.block<E>();
    for (std::size_t e = 0; e < block.size(); ++e) {
      double rows[2][E::num_vertices];
      const int num_rows = E::weight_rows(block.rest[e], block.params[e], rows);
      for (int r = 0; r < num_rows; ++r) {
        for (const double entry : rows[r]) {
          if (!std::isfinite(entry * entry)) refuse_weight(E::name, e);
        }
      }
      add_rows(entries, block.vertices[e], rows, num_rows);
    }
  });
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
    add_rows(entries, t, rows, laplacian_rows(triangle_rest(x), stiffness, rows));
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
