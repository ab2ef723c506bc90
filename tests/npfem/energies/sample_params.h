// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cmath>
#include <type_traits>

#include "energies/energy_list.h"
#include "random_shape.h"

namespace npfem::testing {

/// Parameters of ordinary size for each energy; a new energy of the list does not compile here until it has its own.
template <class E>
typename E::template Params<double> sample_params();

template <>
inline Skalak::Params<double> sample_params<Membrane<Skalak>>() {
  return {3.25, 10};
}
template <>
inline NeoHookean::Params<double> sample_params<Membrane<NeoHookean>>() {
  return {4.0};
}
template <>
inline Yeoh::Params<double> sample_params<Membrane<Yeoh>>() {
  return {3.7, 0.4};
}
template <>
inline LineageSurfaceMaterial::Params<double> sample_params<Membrane<LineageSurfaceMaterial>>() {
  return {35, 5, 27.5};
}
template <>
inline LineageArea::Params<double> sample_params<Membrane<LineageArea>>() {
  return {5000, 1, 1};
}
template <>
inline LocalArea::Params<double> sample_params<Membrane<LocalArea>>() {
  return {200};
}
template <>
inline CollapseBarrier::Params<double> sample_params<Membrane<CollapseBarrier>>() {
  return {68};
}
template <>
inline WormLikeChain::Params<double> sample_params<WormLikeChain>() {
  return {6.3, 1 / 2.2};
}
template <>
inline TriangleStrainLimit::Params<double> sample_params<Membrane<TriangleStrainLimit>>() {
  return {50, 0.98, 1.03};
}
template <>
inline TriangleArap::Params<double> sample_params<Membrane<TriangleArap>>() {
  return {20};
}
template <>
inline EdgeStrainLimit::Params<double> sample_params<EdgeStrainLimit>() {
  return {50, 0.995, 1.005};
}
template <>
inline NeoHookeanSolid::Params<double> sample_params<Tetrahedron<NeoHookeanSolid>>() {
  return {100, 400};
}
template <>
inline TetrahedronStrainLimit::Params<double> sample_params<Tetrahedron<TetrahedronStrainLimit>>() {
  return {50, 0.98, 1.03};
}
template <>
inline TetrahedronArap::Params<double> sample_params<Tetrahedron<TetrahedronArap>>() {
  return {20};
}
template <>
inline TetrahedronVolume::Params<double> sample_params<Tetrahedron<TetrahedronVolume>>() {
  return {500, 1, 1};
}
template <>
inline Closeness::Params<double> sample_params<Closeness>() {
  return {7};
}
template <>
inline LineageBending::Params<double> sample_params<LineageBending>() {
  return {1, 1, 1};
}
template <>
inline DihedralBending::Params<double> sample_params<DihedralBending>() {
  return {0.3, 0};
}
template <>
inline HelfrichParams<double> sample_params<JuelicherBending>() {
  return {0.3, 0, 0};
}
template <>
inline HelfrichParams<double> sample_params<CotangentBending>() {
  return {0.3, 0, 0};
}
template <>
inline ParallelogramShape::Params<double> sample_params<ParallelogramShape>() {
  return {30};
}
template <>
inline RectangleShape::Params<double> sample_params<RectangleShape>() {
  return {30};
}
template <>
inline AngleRange::Params<double> sample_params<AngleRange>() {
  return {30, 0.1, 0.099};
}
template <>
inline ShapeParams<double> sample_params<FittedShape<PlaneShape>>() {
  return {30};
}
template <>
inline ShapeParams<double> sample_params<FittedShape<LineShape>>() {
  return {30};
}
template <>
inline ShapeParams<double> sample_params<FittedShape<CircleShape>>() {
  return {30};
}
template <>
inline ShapeParams<double> sample_params<FittedShape<SphereShape>>() {
  return {30};
}
template <>
inline SimilarityShape::Params<double> sample_params<FittedShape<SimilarityShape>>() {
  return {30, 0.5, 2};
}
template <>
inline Laplacian::Params<double> sample_params<Laplacian>() {
  return {30, 0};
}
template <>
inline GlobalArea::Params<double> sample_params<GlobalArea>() {
  return {2500};
}
template <>
inline GlobalVolume::Params<double> sample_params<GlobalVolume>() {
  return {2000};
}
template <>
inline LineageVolume::Params<double> sample_params<LineageVolume>() {
  return {250};
}

/// How far (um, on elements of about 1 um) vertices are moved where a gradient is compared with finite differences.
template <class E>
constexpr double sample_displacement = 0.08;
/// The four Newton steps of the lineage's projections are exact to round-off up to strains of a few per cent only.
template <>
inline constexpr double sample_displacement<Membrane<LineageArea>> = 0.02;
template <>
inline constexpr double sample_displacement<Tetrahedron<TetrahedronVolume>> = 0.01;

/// How much smaller than at rest a shape is taken: a barrier against collapse feels nothing before.
template <class E>
constexpr double sample_squeeze = 1;
template <>
inline constexpr double sample_squeeze<Membrane<CollapseBarrier>> = 0.4;

template <class E>
constexpr bool is_group = requires {
  E::max_vertices;
};

/// Number of vertices of the elements and groups that the contract is tested on.
template <class E>
constexpr int sample_count = [] {
  if constexpr (is_group<E>) {
    return 7;
  } else {
    return E::num_vertices;
  }
}();

/// Energies that are at rest where the points lie on a shape of a kind, and not in the shape that they had.
template <class E>
constexpr bool fits_a_shape = false;
template <class Law>
constexpr bool fits_a_shape<FittedShape<Law>> = true;
template <>
inline constexpr bool fits_a_shape<FittedShape<SimilarityShape>> = false;
template <bool rectangular>
constexpr bool fits_a_shape<QuadrilateralShape<rectangular>> = true;
template <>
inline constexpr bool fits_a_shape<AngleRange> = true;

template <class E>
constexpr bool is_tetrahedron = false;
template <class Law>
constexpr bool is_tetrahedron<Tetrahedron<Law>> = true;

/// A shape that the energy is made for, of edges about 1 um, each vertex moved at random by up to `noise`: a vertex
/// with its ring, points about a circle or a sphere, otherwise a vertex, an edge, a triangle, a hinge or a tetrahedron.
template <class E>
void sample_shape(Random& random, double noise, Vec3<double> (&x)[sample_count<E>]) {
  constexpr int n = sample_count<E>;
  if constexpr (std::is_same_v<E, FittedShape<SphereShape>>) {
    const Vec3<double> corners[7] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},      {0, -1, 0},
                                     {0, 0, 1}, {0, 0, -1}, {0.6, 0.6, 0.6}};
    for (int i = 0; i < n; ++i) x[i] = corners[i] + random.vector(0.7 * noise);
  } else if constexpr (is_group<E>) {
    // The centre of a ring lies above it; a circle has none.
    const int first = std::is_same_v<E, FittedShape<CircleShape>> ? 0 : 1;
    x[0] = Vec3<double>{0, 0, 0.25} + random.vector(noise);
    for (int i = first; i < n; ++i) {
      const double angle = 2 * 3.141592653589793 * i / (n - first);
      x[i] = Vec3<double>{std::cos(angle), std::sin(angle), 0} + random.vector(noise);
    }
  } else {
    random_element(random, noise, x);
    if constexpr (is_tetrahedron<E>) x[3] = Vec3<double>{0.5, 0.3, 0.9} + random.vector(noise);
  }
}

}  // namespace npfem::testing
