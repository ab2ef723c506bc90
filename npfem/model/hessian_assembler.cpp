// SPDX-License-Identifier: MPL-2.0
#include "model/hessian_assembler.h"

#include <Eigen/Eigenvalues>

namespace npfem {
namespace {

/// `matrix` without its downward curvature: the nearest positive-semidefinite one.
void project(Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  if (!(eigen.eigenvalues()(0) < 0)) return;
  const Eigen::VectorXd kept = eigen.eigenvalues().cwiseMax(0);
  matrix = eigen.eigenvectors() * kept.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

void HessianAssembler::add_block(std::span<const int> vertices) {
  block_ = 0.5 * (block_ + block_.transpose()).eval();
  if (definite_ == Definite::projected) project(block_);
  for (Eigen::Index row = 0; row < block_.rows(); ++row) {
    for (Eigen::Index column = 0; column < block_.cols(); ++column) {
      entries_.emplace_back(3 * vertices[static_cast<std::size_t>(row / 3)] + static_cast<int>(row % 3),
                            3 * vertices[static_cast<std::size_t>(column / 3)] + static_cast<int>(column % 3),
                            block_(row, column));
    }
  }
}

Eigen::SparseMatrix<double> HessianAssembler::matrix() const {
  const auto n = static_cast<Eigen::Index>(x_.size());
  Eigen::SparseMatrix<double> sum(n, n);
  sum.setFromTriplets(entries_.begin(), entries_.end());
  return sum;
}

}  // namespace npfem
