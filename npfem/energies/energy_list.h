// SPDX-License-Identifier: MPL-2.0
#pragma once

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

// The energies of the library. A new one is a header and one word here.

using ElementEnergies = TypeList<Membrane<Skalak>, Membrane<NeoHookean>, Membrane<LineageSurfaceMaterial>,
                                 Membrane<LineageArea>, LineageBending, DihedralBending>;
using CellEnergies = TypeList<GlobalArea, GlobalVolume, LineageVolume>;

}  // namespace npfem
