// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <type_traits>

#include "energies/angle.h"
#include "energies/closeness.h"
#include "energies/collapse_barrier.h"
#include "energies/cotangent_bending.h"
#include "energies/dihedral_bending.h"
#include "energies/edge_strain_limit.h"
#include "energies/global.h"
#include "energies/juelicher_bending.h"
#include "energies/laplacian.h"
#include "energies/lineage_area.h"
#include "energies/lineage_bending.h"
#include "energies/lineage_surface_material.h"
#include "energies/local_area.h"
#include "energies/neo_hookean.h"
#include "energies/neo_hookean_solid.h"
#include "energies/parallelogram.h"
#include "energies/plane_and_line.h"
#include "energies/similarity.h"
#include "energies/skalak.h"
#include "energies/sphere_and_circle.h"
#include "energies/tetrahedron_arap.h"
#include "energies/tetrahedron_strain_limit.h"
#include "energies/tetrahedron_volume.h"
#include "energies/triangle_arap.h"
#include "energies/triangle_strain_limit.h"
#include "energies/wlc.h"
#include "energies/yeoh.h"

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
using MembraneEnergies = TypeList<Membrane<Skalak>, Membrane<NeoHookean>, Membrane<Yeoh>,
                                  Membrane<LineageSurfaceMaterial>, Membrane<LineageArea>, Membrane<LocalArea>,
                                  Membrane<CollapseBarrier>, Membrane<TriangleStrainLimit>, Membrane<TriangleArap>>;

/// Other energies of a fixed number of vertices; each element stands alone.
using LoneElementEnergies =
    TypeList<WormLikeChain, EdgeStrainLimit, LineageBending, DihedralBending, Tetrahedron<NeoHookeanSolid>,
             Tetrahedron<TetrahedronStrainLimit>, Tetrahedron<TetrahedronArap>, Tetrahedron<TetrahedronVolume>,
             ParallelogramShape, RectangleShape, AngleRange, Closeness>;

using ElementEnergies = decltype(joined(MembraneEnergies{}, LoneElementEnergies{}));

/// Of any number of vertices up to `max_vertices`, like the ring around a vertex.
using GroupEnergies =
    TypeList<JuelicherBending, CotangentBending, FittedShape<PlaneShape>, FittedShape<LineShape>,
             FittedShape<CircleShape>, FittedShape<SphereShape>, FittedShape<SimilarityShape>, Laplacian>;

/// Of the whole cell.
using CellEnergies = TypeList<GlobalArea, GlobalVolume, LineageVolume>;

/// An element energy feels no translation unless it says so: `static constexpr bool translation_invariant = false`.
template <class E>
inline constexpr bool is_translation_invariant_energy = [] {
  if constexpr (requires { E::translation_invariant; }) {
    return E::translation_invariant;
  } else {
    return true;
  }
}();

/// Most rows that weight_rows of an element energy writes.
template <class E>
inline constexpr int max_weight_rows = E::num_vertices > 1 ? E::num_vertices - 1 : 1;

}  // namespace npfem
