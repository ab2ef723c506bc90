// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "coupling/cell_population.h"
#include "coupling/coupling.h"
#include "coupling/fluid_link.h"
#include "coupling/outer_traction.h"

namespace npfem::flow {

/// The scheme of Palabos-npFEM (Kotsalos, Latt & Chopard, J. Comput. Phys. 398 (2019) 108905), for comparison only.
/// Fluid and cells act on each other by two forces that have nothing to do with each other:
///   on the cell    the stress of the fluid outside it at x_n (outer_traction.h) and the contacts, which accelerate the
///                  cell's own mass m_s in one implicit step of delta to the velocity v_n+1;
///   on the fluid   direct forcing (Inamuro 2012): at every vertex the momentum that a layer of fluid one node thick
///                  lacks to move with the vertex, F = rho dx A (v - u) / dt, some iterations of it in every fluid
///                  step, at the vertices' places in that step and with the velocity they came there by.
/// So the momentum of fluid and cells together is not kept, and the audit says by how much.
///
/// The lineage adds the force to the momentum that its collision relaxes towards, and forces again from that; here it
/// is a force of the lattice (Guo), and u counts half of what acts in the coming step.
class LineageCoupling final : public Coupling {
 public:
  /// std::invalid_argument where a type of cell has a vertex without mass of its own.
  LineageCoupling(const Setup& setup, CellPopulation& cells, FluidLink& fluid, OuterTraction traction);
  /// The fluid learns of the cells in the first step.
  void hold_present_forces() override {}
  CellStepReport load_fluid() override;
  void renew_load(int steps_since_solve) override;

 private:
  void force_fluid();

  CellPopulation& cells_;
  FluidLink& lattice_;
  OuterTraction traction_;
  Vec3 outside_{};  // what the cells' own mass has given up, pN
  std::vector<double> crowded_, external_, fluid_velocity_;  // own vertices
};

}  // namespace npfem::flow
