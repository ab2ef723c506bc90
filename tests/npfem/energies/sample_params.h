// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "energies/energy_list.h"

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
inline LineageSurfaceMaterial::Params<double> sample_params<Membrane<LineageSurfaceMaterial>>() {
  return {35, 5, 27.5};
}
template <>
inline LineageArea::Params<double> sample_params<Membrane<LineageArea>>() {
  return {5000, 1, 1};
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
/// The four Newton steps of the lineage's projection are exact to round-off up to strains of a few per cent only.
template <>
inline constexpr double sample_displacement<Membrane<LineageArea>> = 0.02;

}  // namespace npfem::testing
