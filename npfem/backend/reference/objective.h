// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/reference/dissipation.h"
#include "backend/reference/vertex_field.h"

namespace npfem {

/// What one implicit step of one cell minimises, over the displacements d from the start x_n:
///   Phi(d) = 1/2 |d - drift|^2_mu - force . d + E(x_n + d) + D(d) + patches,
/// mu = M/h^2 (pN/um). Its minimum is the step of time_step.h; with mu = D = 0 it is a static equilibrium.
struct StepObjective {
  const Model& model;
  const VertexField& start;        ///< x_n, um
  const Eigen::VectorXd& inertia;  ///< mu per vertex, pN/um
  const VertexField& drift;        ///< where inertia alone would bring each vertex, um
  const VertexField& force;        ///< constant forces, pN
  const Dissipation& dissipation;  ///< D
  std::span<const Patch> patches;
  const VertexField& tied_at;  ///< where the springs of the patches are at rest, um

  /// Returns Phi (pN um); writes its gradient (pN). `scale` receives the sum of the magnitudes of Phi's parts: rounding
  /// of Phi is a few 1e-16 of it.
  double operator()(const VertexField& displacement, VertexField& gradient, double& scale) const;
};

}  // namespace npfem
