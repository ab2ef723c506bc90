// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/ring.h"

namespace npfem {

// Helfrich's bending energy, 2 kappa times the integral of (H - H0)^2, on the ring of each vertex:
//   E = 2 kappa (M - A H0)^2 / A,
// A: one third of the vertex's triangles, M: integral of the mean curvature H (positive where convex) over A. H0 is
// half of Helfrich's spontaneous curvature c0. The energy of a closed surface tends to the continuum's as the mesh is
// refined, and does not depend on the size of the cell.

template <class R>
struct HelfrichParams {
  R modulus;                ///< kappa, pN um (1e-18 J)
  R spontaneous_curvature;  ///< H0, 1/um, where `uniform` is 1
  R uniform;                ///< 1: H0 as given; 0: the mean curvature of the rest shape, vertex by vertex
};

/// What enters the quasi-Newton matrix: near a flat rest shape 2 H A n is the Laplacian row applied to x, and
/// E = (kappa/2) |row x|^2 / A.
template <class R>
struct HelfrichWeight {
  R area;                          ///< A at rest, um^2
  R laplacian[max_ring_vertices];  ///< row of the rest shape, 1

  int rows(const R& modulus, int count, R (*rows)[max_ring_vertices]) const {
    const R scale = square_root(modulus / area);
    for (int i = 0; i < count; ++i) rows[0][i] = scale * laplacian[i];
    return 1;
  }
};

template <class R>
NPFEM_HD HelfrichWeight<R> helfrich_weight(const Vec3<R>* x, int count, const R& area) {
  HelfrichWeight<R> weight;
  weight.area = area;
  for (int i = count; i < max_ring_vertices; ++i) weight.laplacian[i] = R(0);
  ring_laplacian(x, count, weight.laplacian);
  return weight;
}

}  // namespace npfem
