// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/number.h"

namespace npfem {

// Energies of a whole cell: they see only its sums, and answer with slopes by area and volume.

/// Sums over the closed surface of one cell.
template <class T>
struct CellSums {
  T area;                    ///< um^2
  T volume;                  ///< um^3
  T volume_gradient_square;  ///< sum over vertices of |dV/dx|^2, um^4
};

template <class T>
struct CellResponse {
  T energy;     ///< pN um
  T by_area;    ///< dE/dA, pN/um
  T by_volume;  ///< dE/dV, Pa
};

template <class R>
struct CellRest {
  R area;    ///< A0, um^2
  R volume;  ///< V0, um^3
};

/// Total area: E = (k_A/2) (A - A0)^2 / A0. The bilayer slides over the skeleton but hardly stretches.
struct GlobalArea {
  static constexpr const char* name = "global_area";
  static constexpr bool uses_area = true, uses_volume = false;
  static constexpr bool exact_gradient = true;
  template <class R>
  struct Params {
    R modulus;  ///< k_A, uN/m
  };
  template <class T, class R>
  NPFEM_HD static CellResponse<T> respond(const CellSums<T>& sums, const CellRest<R>& rest, const Params<R>& p) {
    const T strain = (sums.area - rest.area) / rest.area;
    return {R(0.5) * p.modulus * rest.area * strain * strain, p.modulus * strain, T(R(0))};
  }
};

/// Enclosed volume: E = (k_V/2) (V - V0)^2 / V0. The membrane passes no water on the time scale of flow.
struct GlobalVolume {
  static constexpr const char* name = "global_volume";
  static constexpr bool uses_area = false, uses_volume = true;
  static constexpr bool exact_gradient = true;
  template <class R>
  struct Params {
    R modulus;  ///< k_V, Pa
  };
  template <class T, class R>
  NPFEM_HD static CellResponse<T> respond(const CellSums<T>& sums, const CellRest<R>& rest, const Params<R>& p) {
    const T strain = (sums.volume - rest.volume) / rest.volume;
    return {R(0.5) * p.modulus * rest.volume * strain * strain, T(R(0)), p.modulus * strain};
  }
};

/// The lineage's volume term: spring to the nearest (linearised) shape of the right volume,
///   E = (k/2) (V - V0)^2 / |grad V|^2, with a force that leaves out how |grad V| varies.
struct LineageVolume {
  static constexpr const char* name = "lineage_volume";
  static constexpr bool uses_area = false, uses_volume = true;
  static constexpr bool exact_gradient = false;
  template <class R>
  struct Params {
    R weight;  ///< k, pN/um
  };
  template <class T, class R>
  NPFEM_HD static CellResponse<T> respond(const CellSums<T>& sums, const CellRest<R>& rest, const Params<R>& p) {
    const T excess = sums.volume - rest.volume;
    const T slope = p.weight * excess / larger(sums.volume_gradient_square, T(R(1e-30)));
    return {R(0.5) * slope * excess, T(R(0)), slope};
  }
};

}  // namespace npfem
