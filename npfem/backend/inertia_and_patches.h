// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/SparseCore>
#include <span>

#include "backend/backend.h"

namespace npfem {

/// What the matrix of a step holds beside the energies: `inertia` (pN/um) on the diagonal, and for each patch the
/// springs from its vertices to its mean, stiffness * (1 - 1/m), a small dense block. `copies`: coordinates per vertex,
/// 1 or 3.
Eigen::SparseMatrix<double> inertia_and_patches(const Eigen::VectorXd& inertia, std::span<const Patch> patches,
                                                int copies);

}  // namespace npfem
