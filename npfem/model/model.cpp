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

[[noreturn]] void refuse_weight(const char* energy, std::size_t element) {
  throw Error(Status::bad_input, "energy " + std::string(energy) + ", element " + std::to_string(element) +
                                     ": its weight in the matrix of the solver is not finite: needed are a rest shape "
                                     "of positive area and a finite modulus of at least 0");
}

Eigen::SparseMatrix<double> assemble_weight(const Model& model) {
  std::vector<Eigen::Triplet<double>> entries;
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    const auto& block = model.block<E>();
    for (std::size_t e = 0; e < block.size(); ++e) {
      double rows[2][E::num_vertices];
      const int num_rows = E::weight_rows(block.rest[e], block.params[e], rows);
      for (int r = 0; r < num_rows; ++r) {
        for (int i = 0; i < E::num_vertices; ++i) {
          if (!std::isfinite(rows[r][i] * rows[r][i])) refuse_weight(E::name, e);
          for (int j = 0; j < E::num_vertices; ++j) {
            entries.emplace_back(block.vertices[e][static_cast<std::size_t>(i)],
                                 block.vertices[e][static_cast<std::size_t>(j)], rows[r][i] * rows[r][j]);
          }
        }
      }
    }
  });
  Eigen::SparseMatrix<double> weight(model.num_vertices(), model.num_vertices());
  weight.setFromTriplets(entries.begin(), entries.end());
  return weight;
}

}  // namespace

void complete_model(Model& model) {
  const TriangleMesh surface{model.initial, model.triangles};
  model.vertex_area = vertex_areas(surface);
  model.rest = {surface_area(surface), signed_volume(surface)};
  model.weight = assemble_weight(model);
}

}  // namespace npfem
