// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/SparseCholesky>
#include <span>

#include "backend/backend.h"
#include "backend/reference/vertex_field.h"

namespace npfem {

/// Throws Error(bad_input): the matrix of a step is not positive definite, and why that may be.
[[noreturn]] void refuse_step_matrix();

/// The constant matrix of a quasi-Newton iteration, factorised once and shared by all cells of a model:
///   N = diag(diagonal) + scales.elastic * W + scales.viscous * W_v + patches,
/// W the sum of the energies' weights, W_v that of the membrane viscosity. One n x n matrix serves x, y and z.
class StepFactor {
 public:
  struct Scales {
    double elastic;
    double viscous;  ///< 1/h, 1/us
  };
  /// `diagonal` in pN/um. Throws Error(bad_input) where N is not positive definite.
  StepFactor(const Model& model, const Eigen::VectorXd& diagonal, Scales scales, std::span<const Patch> patches);

  VertexField solve(const VertexField& force) const;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace npfem
