// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "energies/energy_list.h"
#include "energies/membrane_viscosity.h"
#include "mesh/triangle_mesh.h"

namespace npfem {

/// All elements of one energy: which vertices, how stiff, and what they remember of their rest shape.
template <class E>
struct ElementBlock {
  std::vector<std::array<int, E::num_vertices>> vertices;
  std::vector<typename E::template Params<double>> params;
  std::vector<typename E::template Rest<double>> rest;

  std::size_t size() const { return vertices.size(); }
};

template <class List>
struct BlocksOf;
template <class... Es>
struct BlocksOf<TypeList<Es...>> {
  using type = std::tuple<ElementBlock<Es>...>;
};
using ElementBlocks = BlocksOf<ElementEnergies>::type;

template <class List>
struct TermsOf;
template <class... Es>
struct TermsOf<TypeList<Es...>> {
  using type = std::tuple<std::optional<typename Es::template Params<double>>...>;
};
using CellTerms = TermsOf<CellEnergies>::type;

/// One type of cell: everything that its cells share. Never changes once built, so any number of threads may read it.
struct Model {
  std::vector<Point> initial;       ///< shape of a new cell, um
  std::vector<Triangle> triangles;  ///< surface, outward
  std::vector<double> vertex_area;  ///< one third of the rest area of the triangles at each vertex, um^2
  std::vector<double> solid_mass;   ///< per vertex, fg
  ElementBlocks elements;
  CellTerms cell_terms;
  CellRest<double> rest{};             ///< area and volume at rest
  Eigen::SparseMatrix<double> weight;  ///< sum of the energies' constant weights, n x n for each coordinate, pN/um
  MembraneViscosity::Params<double> viscosity{0, 0};  ///< of the membrane, pN us/um
  Eigen::SparseMatrix<double> viscous_weight;         ///< its weight in a step, times the step, pN us/um
  double shear_modulus = 0;                           ///< small strain, uN/m
  double largest_modulus = 0;                         ///< stiffest surface modulus, uN/m

  int num_vertices() const { return static_cast<int>(initial.size()); }

  template <class E>
  const ElementBlock<E>& block() const {
    return std::get<ElementBlock<E>>(elements);
  }
  template <class E>
  ElementBlock<E>& block() {
    return std::get<ElementBlock<E>>(elements);
  }
  bool has_cell_terms() const;
  bool is_viscous() const { return viscosity.shear > 0 || viscosity.dilatational > 0; }
  /// Names of the energies that this model evaluates: element energies first, in the order of the type lists.
  std::vector<std::string> energy_names() const;
};

template <class E>
const auto& cell_term(const Model& model) {
  return std::get<static_cast<std::size_t>(index_in<E>(CellEnergies{}))>(model.cell_terms);
}
template <class E>
auto& cell_term(Model& model) {
  return std::get<static_cast<std::size_t>(index_in<E>(CellEnergies{}))>(model.cell_terms);
}

}  // namespace npfem
