// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/step_factor.h"

#include "backend/inertia_and_patches.h"
#include "error.h"

namespace npfem {

void refuse_step_matrix() {
  throw Error(
      Status::bad_input,
      "the matrix M/dt^2 + W is not positive definite: every vertex needs a mass (solid_mass + ambient_mass > 0), the "
      "time_step must not be so long nor a patch so stiff that M/dt^2 is lost in the rounding of W, and the material "
      "needs a membrane or bending law of positive modulus");
}

StepFactor::StepFactor(const Model& model, const Eigen::VectorXd& diagonal, Scales scales,
                       std::span<const Patch> patches) {
  Eigen::SparseMatrix<double> matrix = inertia_and_patches(diagonal, patches, 1);
  matrix += scales.elastic * model.weight;
  if (model.is_viscous() && scales.viscous > 0) matrix += scales.viscous * model.viscous_weight;
  factor_.compute(matrix);
  if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0)) {
    refuse_step_matrix();
  }
}

VertexField StepFactor::solve(const VertexField& force) const {
  return factor_.solve(force);
}

}  // namespace npfem
