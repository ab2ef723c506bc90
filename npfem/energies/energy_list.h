// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <type_traits>

#include "energies/dihedral_bending.h"
#include "energies/global.h"
#include "energies/lineage_area.h"
#include "energies/lineage_bending.h"
#include "energies/lineage_surface_material.h"
#include "energies/neo_hookean.h"
#include "energies/skalak.h"

namespace npfem {

template <class... Types>
struct TypeList {};

template <class T>
struct Type {
  using type = T;
};

/// Calls f(Type<E>{}) for each energy of a list.
template <class... Types, class F>
void for_each_energy(TypeList<Types...>, F&& f) {
  (f(Type<Types>{}), ...);
}

template <class... Types>
constexpr int list_length(TypeList<Types...>) {
  return sizeof...(Types);
}

/// Place of an energy in its list.
template <class E, class First, class... Rest>
constexpr int index_in(TypeList<First, Rest...>) {
  if constexpr (std::is_same_v<E, First>) {
    return 0;
  } else {
    return 1 + index_in<E>(TypeList<Rest...>{});
  }
}

template <class... As, class... Bs>
TypeList<As..., Bs...> joined(TypeList<As...>, TypeList<Bs...>);

// The energies of the library. A new one is a header and one word here.

/// Laws of a membrane of triangles: those on one triangle share its strain.
using MembraneEnergies =
    TypeList<Membrane<Skalak>, Membrane<NeoHookean>, Membrane<LineageSurfaceMaterial>, Membrane<LineageArea>>;
/// Other energies of a fixed number of vertices; each element stands alone.
using LoneElementEnergies = TypeList<LineageBending, DihedralBending>;
using ElementEnergies = decltype(joined(MembraneEnergies{}, LoneElementEnergies{}));
/// Energies of any number of vertices.
using GroupEnergies = TypeList<>;
using CellEnergies = TypeList<GlobalArea, GlobalVolume, LineageVolume>;

}  // namespace npfem
