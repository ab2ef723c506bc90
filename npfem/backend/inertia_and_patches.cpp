// SPDX-License-Identifier: MPL-2.0
#include "backend/inertia_and_patches.h"

#include <vector>

namespace npfem {

Eigen::SparseMatrix<double> inertia_and_patches(const Eigen::VectorXd& inertia, std::span<const Patch> patches,
                                                int copies) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j, double stiffness) {
    for (int axis = 0; axis < copies; ++axis) entries.emplace_back(copies * i + axis, copies * j + axis, stiffness);
  };
  for (int i = 0; i < static_cast<int>(inertia.size()); ++i) add(i, i, inertia(i));
  for (const Patch& patch : patches) {
    const double share = patch.stiffness / static_cast<double>(patch.vertices.size());
    for (const int i : patch.vertices) {
      add(i, i, patch.stiffness);
      for (const int j : patch.vertices) add(i, j, -share);
    }
  }
  const Eigen::Index size = copies * inertia.size();
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace npfem
