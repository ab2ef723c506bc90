// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/reference/minimise.h"

namespace npfem {

/// Minimisation of one cell's objective by Newton's method, with the exact second derivative of its energies where that
/// is positive definite and the projected one elsewhere (Teran et al. 2005), and the dense parts by the
/// Sherman-Morrison-Woodbury formula. Some ten times the cost of a quasi-Newton iteration, but a stiff or strongly bent
/// cell that takes those hundreds of iterations, or stops them, takes Newton about ten.
///
/// The line search never goes uphill. On return `displacement` is the best point found and `gradient` its residual
/// force.
CellReport newton_minimise(const StepObjective& objective, const SolverOptions& options, const MinimiseLimits& limits,
                           VertexField& displacement, VertexField& gradient);

/// Goes on with Newton's method where a minimisation stopped short of its tolerance, from the point it reached, for up
/// to options.newton_iterations; `report` then covers both.
void finish_by_newton(const StepObjective& objective, const SolverOptions& options, VertexField& displacement,
                      VertexField& gradient, CellReport& report);

}  // namespace npfem
