// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem {

/// How the last step of one cell ended. The numbers are part of the C ABI.
enum class CellStatus : int {
  converged = 0,
  iteration_cap = 1,  ///< usable: residual above the tolerance, below SolverOptions::residual_bound
  not_finite = 2,
  no_descent = 3,
  not_converged = 4,
};

inline bool has_failed(CellStatus status) {
  return status >= CellStatus::not_finite;
}

struct CellReport {
  CellStatus status = CellStatus::converged;
  int iterations = 0;
  int evaluations = 0;
  int hessian_iterations = 0;  ///< those of the iterations that were guided by the Hessian of the rest shape
  double residual = 0;         ///< largest component of the residual force, pN
  double tolerance = 0;        ///< the one used: that of the options, or what rounding allows where that is more, pN
};

}  // namespace npfem
