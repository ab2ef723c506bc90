// SPDX-License-Identifier: MPL-2.0
// A model laid out for the kernels: plain pointers to plain numbers, because code compiled for one instruction set may
// not contain anything that the linker could share with code compiled for another.
#pragma once

#include "energies/energy_list.h"
#include "energies/membrane_viscosity.h"

namespace npfem::cpu {

constexpr int num_element_energies = list_length(ElementEnergies{});
constexpr int num_group_energies = list_length(GroupEnergies{});
constexpr int num_cell_energies = list_length(CellEnergies{});
/// Place of the first group and the first cell energy in a ledger of energies by their place in the lists.
constexpr int first_group_energy = num_element_energies;
constexpr int first_cell_energy = first_group_energy + num_group_energies;
constexpr int num_energies = first_cell_energy + num_cell_energies;

/// The parameters of one energy, per element; one entry for all where `stride` is 0.
template <class E, class R>
struct ParamView {
  const typename E::template Params<R>* params = nullptr;  ///< null: the model does not use this energy here
  int stride = 0;
};

/// Triangles that share one strain for all membrane laws upon them.
template <class List, class R>
struct TriangleGroup;
template <class... Es, class R>
struct TriangleGroup<TypeList<Es...>, R> : ParamView<Es, R>... {
  int count = 0;
  const int (*vertices)[3] = nullptr;
  const TriangleRest<R>* rest = nullptr;
  bool is_surface = false;  ///< its areas and volumes add up to those of the cell
  template <class E>
  const ParamView<E, R>& law() const {
    return *this;
  }
};

/// The elements of an energy that is not a membrane law.
template <class E, class R>
struct ElementView {
  int count = 0;
  const int (*vertices)[E::num_vertices] = nullptr;
  const typename E::template Rest<R>* rest = nullptr;
  ParamView<E, R> params;
};
template <class List, class R>
struct ElementViews;
template <class... Es, class R>
struct ElementViews<TypeList<Es...>, R> : ElementView<Es, R>... {
  template <class E>
  const ElementView<E, R>& of() const {
    return *this;
  }
  template <class E>
  ElementView<E, R>& of() {
    return *this;
  }
};

/// Energies of groups of vertices of any number.
template <class G, class R>
struct GroupView {
  int count = 0;
  const int* offsets = nullptr;  ///< group g has the vertices[offsets[g]] to vertices[offsets[g + 1]]
  const int* vertices = nullptr;
  const typename G::template Rest<R>* rest = nullptr;
  ParamView<G, R> params;
};
template <class List, class R>
struct GroupViews;
template <class... Gs, class R>
struct GroupViews<TypeList<Gs...>, R> : GroupView<Gs, R>... {
  template <class G>
  const GroupView<G, R>& of() const {
    return *this;
  }
  template <class G>
  GroupView<G, R>& of() {
    return *this;
  }
};

template <class E, class R>
struct CellTermView {
  bool present = false;
  typename E::template Params<R> params{};
};
template <class List, class R>
struct CellTermViews;
template <class... Es, class R>
struct CellTermViews<TypeList<Es...>, R> : CellTermView<Es, R>... {
  template <class E>
  const CellTermView<E, R>& of() const {
    return *this;
  }
  template <class E>
  CellTermView<E, R>& of() {
    return *this;
  }
};

/// Vertices that a host holds together (Patch), in the kernels' order.
template <class R>
struct PatchView {
  int count;
  const int* vertices;
  R stiffness;  ///< pN/um
};

/// One model in numbers of type R. Vertices are in the order of elimination of the matrices (see SharedFactors).
template <class R>
struct CellPlan {
  int num_vertices = 0;
  int num_groups = 0;
  const TriangleGroup<MembraneEnergies, R>* groups = nullptr;
  ElementViews<LoneElementEnergies, R> elements;
  GroupViews<GroupEnergies, R> vertex_groups;
  CellTermViews<CellEnergies, R> cell_terms;
  bool needs_area = false, needs_volume = false;  ///< by a cell energy
  bool is_translation_invariant = true;           ///< false where vertices are held to fixed places
  bool has_potential = true;  ///< every force is the gradient of its energy; not so for LineageVolume
  CellRest<R> rest{};
  bool is_viscous = false;
  MembraneViscosity::Params<R> viscosity{};  ///< on the triangles of the group that is the surface
  const int (*surface)[3] = nullptr;         ///< those triangles
  int num_surface_triangles = 0;
  R stiffest_diagonal = 0;  ///< of the weight matrix, pN/um: how large elastic forces get per um
  R viscous_diagonal = 0;   ///< the same of the viscous weight, pN us/um
};

}  // namespace npfem::cpu
