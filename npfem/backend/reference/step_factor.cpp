// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/step_factor.h"

#include <vector>

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
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < model.num_vertices(); ++i) entries.emplace_back(i, i, diagonal(i));
  // Springs to the mean of a patch: stiffness * (1 - 1/m), a small dense block.
  for (const Patch& patch : patches) {
    const double share = patch.stiffness / static_cast<double>(patch.vertices.size());
    for (const int i : patch.vertices) {
      entries.emplace_back(i, i, patch.stiffness);
      for (const int j : patch.vertices) entries.emplace_back(i, j, -share);
    }
  }
  Eigen::SparseMatrix<double> matrix(model.num_vertices(), model.num_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
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
