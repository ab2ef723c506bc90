// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "backend/reference/vertex_field.h"
#include "model/hessian.h"
#include "model/model.h"

namespace npfem {

/// The incremental dissipation D of one step of one cell: what its membrane viscosity costs. Its gradient is the
/// viscous force at the end of the step.
class Dissipation {
 public:
  /// None, as in a static equilibrium.
  explicit Dissipation(const Model& model) : model_(model) {}
  /// Of a step from `start` (um) with the differencing dg/dt = (g - g_n - past (g_n - g_{n-1}))/h, h in us;
  /// `last_move` = x_n - x_{n-1} (um).
  Dissipation(const Model& model, const VertexField& start, const VertexField& last_move, double past, double h);

  /// D (pN um) of the displacements from the start; adds its gradient (pN).
  double operator()(const VertexField& displacement, VertexField& gradient) const;

  /// Its second derivative by the displacements, 3n x 3n, pN/um.
  Eigen::SparseMatrix<double> hessian(const VertexField& displacement, Definite definite) const;

  /// Of its weight in the quasi-Newton matrix, pN/um.
  double stiffest_diagonal() const { return per_lead_ * model_.viscous_weight.diagonal().maxCoeff(); }

 private:
  const Model& model_;
  double per_lead_ = 0;                                      // 1/h, 1/us
  MembraneViscosity::Params<double> per_time_{0, 0};         // eta/h, uN/m
  std::vector<MembraneViscosity::Start<double>> triangles_;  // empty: no viscosity
};

}  // namespace npfem
