// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <optional>
#include <span>
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

/// The same for groups of any number of vertices: group g has vertices[offsets[g]] to vertices[offsets[g + 1] - 1].
template <class G>
struct GroupBlock {
  std::vector<int> offsets{0};
  std::vector<int> vertices;
  std::vector<typename G::template Params<double>> params;
  std::vector<typename G::template Rest<double>> rest;

  std::size_t size() const { return params.size(); }
  std::span<const int> group(std::size_t g) const {
    return std::span(vertices).subspan(static_cast<std::size_t>(offsets[g]),
                                       static_cast<std::size_t>(offsets[g + 1] - offsets[g]));
  }
};

template <template <class> class Block, class List>
struct BlocksOf;
template <template <class> class Block, class... Es>
struct BlocksOf<Block, TypeList<Es...>> {
  using type = std::tuple<Block<Es>...>;
};
using ElementBlocks = BlocksOf<ElementBlock, ElementEnergies>::type;
using GroupBlocks = BlocksOf<GroupBlock, GroupEnergies>::type;

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
  GroupBlocks groups;
  CellTerms cell_terms;
  CellRest<double> rest{};             ///< area and volume at rest
  Eigen::SparseMatrix<double> weight;  ///< sum of the energies' constant weights, n x n for each coordinate, pN/um
  MembraneViscosity::Params<double> viscosity{0, 0};  ///< of the membrane, pN us/um
  Eigen::SparseMatrix<double> viscous_weight;         ///< its weight in a step, times the step, pN us/um
  double shear_modulus = 0;                           ///< small strain, uN/m
  double largest_modulus = 0;                         ///< stiffest surface modulus, uN/m

  Eigen::Map<const Eigen::VectorXd> solid_masses() const {
    return {solid_mass.data(), static_cast<Eigen::Index>(solid_mass.size())};
  }
  int num_vertices() const { return static_cast<int>(initial.size()); }

  template <class E>
  const ElementBlock<E>& block() const {
    return std::get<ElementBlock<E>>(elements);
  }
  template <class E>
  ElementBlock<E>& block() {
    return std::get<ElementBlock<E>>(elements);
  }
  template <class G>
  const GroupBlock<G>& group_block() const {
    return std::get<GroupBlock<G>>(groups);
  }
  template <class G>
  GroupBlock<G>& group_block() {
    return std::get<GroupBlock<G>>(groups);
  }
  bool has_cell_terms() const;
  bool is_viscous() const { return viscosity.shear > 0 || viscosity.dilatational > 0; }
  /// Whether every force is the gradient of its energy; not so for the lineage's volume term.
  bool has_potential() const;
  /// False where an energy holds vertices to fixed places: a rigid translation then costs energy.
  bool is_translation_invariant() const;
  /// Names of the energies that this model evaluates: of elements, of groups, of the cell, each in the order of its
  /// list.
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
