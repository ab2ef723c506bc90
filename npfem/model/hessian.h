// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "model/model.h"

namespace npfem {

// The exact second derivative of a cell's elastic energy, pN/um, by forward-mode differentiation of the gradients that
// the energies themselves give. Coordinates in the order xyzxyz..., as in a field.

/// What is done about the directions in which an element's energy curves downward (a compressed triangle buckles).
enum class Definite {
  exact,      ///< nothing: the true second derivative, possibly indefinite
  projected,  ///< each element's negative eigenvalues become zero, so that the sum is positive semidefinite (Teran,
              ///< Sifakis, Irving & Fedkiw 2005, "Robust quasistatic finite elements and flesh simulation")
};

/// A part `stiffness * direction direction^T` of the second derivative, dense because every vertex feels the total area
/// or volume.
struct GlobalStiffness {
  Eigen::VectorXd direction;  ///< dA/dx (um) or dV/dx (um^2), 3n
  double stiffness;           ///< d2E/dA2 or d2E/dV2
};

/// The sparse part, 3n x 3n and symmetric: all element energies, and dE/dA d2A/dx2 + dE/dV d2V/dx2 of the energies of
/// the whole cell. `x`: 3n positions, um.
Eigen::SparseMatrix<double> elastic_hessian(const Model& model, std::span<const double> x, Definite definite);

/// The dense parts of the energies of the whole cell that act at x. Of LineageVolume, whose force is no gradient, it is
/// the derivative by the volume alone.
std::vector<GlobalStiffness> global_stiffness(const Model& model, std::span<const double> x);

}  // namespace npfem
