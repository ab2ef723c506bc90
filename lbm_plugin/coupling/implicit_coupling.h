// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "coupling/coupling.h"

namespace npfem::flow {

/// The default: the cell solver's implicit step feels the fluid through the mass m_f of it that moves with each vertex.
/// With u the fluid velocity at x_n, half of the held force included, and f_old the force held so far, a cell minimises
///   m_f |x - (x_n + delta u - delta^2 f_old / m_f)|^2 / (2 delta^2) + E(x)   (+ its own mass and loads)
/// and F = f_old + m_f (v - u) / delta is spread at x_n and held for delta. With no mass and loads of its own, F =
/// -dE/dx at the solution.
///
/// This is Peskin's method for tracers X, joined to the vertices x by springs of stiffness m_f / delta^2 with the cell
/// relaxed in every step: the fluid never feels a stiffness above m_f / delta^2, so the scheme is stable however stiff
/// the cell. f_old keeps the slip from adding up; without it the membrane would leak like a porous one. What remains is
/// the compliance of those springs, kappa = delta^2 G / (rho ell a^2): see limits.h.
class ImplicitCoupling final : public Coupling {
 public:
  ImplicitCoupling(const Setup& setup, ImmersedSolid& solid, Fluid& fluid);
  CellStepReport load_fluid() override;

 private:
  Vec3 given_way();

  std::vector<double> stiffness_, before_;  // own vertices
};

}  // namespace npfem::flow
