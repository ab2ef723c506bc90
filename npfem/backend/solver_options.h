// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace npfem {

/// How a step forms derivatives in time. The numbers are those of the option "integrator".
enum Integrator : int { implicit_euler = 0, bdf2 = 1 };
/// Numbers of the back end cpu. Mixed: single precision for matrices and history, which only steer the search.
enum Precision : int { double_precision = 0, mixed_precision = 1, single_precision = 2 };
/// Around which matrix the back end cpu iterates.
enum MatrixChoice : int { chosen_matrix = 0, scalar_matrix = 1, hessian_matrix = 2 };

/// Settings of a batch, the same for every back end.
struct SolverOptions {
  double time_step = 0.25;  ///< us
  int integrator = implicit_euler;
  double tolerance = 1e-4;      ///< pN, on the largest component of the residual force
  double residual_bound = 1.0;  ///< pN: at the iteration cap a smaller residual is a warning, a larger one a failure
  int max_iterations = 200;
  int relax_iterations = 2000;  ///< cap of a static solve
  int newton_iterations = 100;  ///< cap of Newton's method, where a quasi-Newton solve stops short of the tolerance
  int history = 7;              ///< pairs kept by L-BFGS
  int max_line_search = 20;     ///< trials per iteration

  int precision = double_precision;  ///< back end cpu
  int threads = 0;                   ///< back end cpu: 0 is OMP_NUM_THREADS, or one where that is not set
  int matrix = chosen_matrix;        ///< back end cpu
  int lone_cells = 0;  ///< back end cpu: 1 puts the elements of one cell into the SIMD lanes instead of many cells

  bool lineage = false;      ///< step exactly as the lineage does
  double lineage_alpha = 0;  ///< Calpha: share of the non-rigid velocity removed in each step
  double lineage_beta = 0;   ///< Cbeta, us: damping proportional to the weight matrix
  double lineage_tolerance = 1e-5;
  int lineage_window = 5;          ///< objective values whose relative scatter is compared with the tolerance
  int lineage_attempts = 7;        ///< failed line searches allowed in a step
  double lineage_armijo = 1e-4;    ///< gamma
  double lineage_curvature = 0.9;  ///< gamma2
};

/// One number among the options.
struct OptionInfo {
  const char* key;
  const char* unit;
  const char* doc;
  double least, largest;
  std::variant<double SolverOptions::*, int SolverOptions::*> member;
};

std::span<const OptionInfo> solver_options();

/// By key. Throws Error(unknown_name) with the nearest key, Error(bad_input) out of range; the options are then
/// unchanged.
double get_option(const SolverOptions& options, std::string_view key);
void set_option(SolverOptions& options, std::string_view key, double value);

/// Throws Error(bad_input) for the first option out of its range: options may also be set past set_option.
void require_valid(const SolverOptions& options);

}  // namespace npfem
