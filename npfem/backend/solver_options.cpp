// SPDX-License-Identifier: MPL-2.0
#include "backend/solver_options.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "error.h"
#include "nearest.h"
#include "quantity.h"

namespace npfem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using S = SolverOptions;

constexpr std::array<OptionInfo, 20> table{{
    {"time_step", "us", "time step of the cell solver", 1e-9, 1e12, &S::time_step},
    {"integrator", "1",
     "0: implicit Euler, first order in the time step; 1: BDF2, second order, for cells without a fluid", 0, 1,
     &S::integrator},
    {"tolerance", "pN", "largest component of the residual force at which a cell has converged", 0, infinity,
     &S::tolerance},
    {"residual_bound", "pN",
     "at the iteration cap, a smaller residual is a warning and a larger one a "
     "failure",
     0, infinity, &S::residual_bound},
    {"max_iterations", "1", "quasi-Newton iterations allowed in a step", 1, 1e9, &S::max_iterations},
    {"relax_iterations", "1", "quasi-Newton iterations allowed in a static solve", 1, 1e9, &S::relax_iterations},
    {"newton_iterations", "1",
     "iterations of Newton's method allowed where the quasi-Newton iterations stop short of the tolerance; 0: none", 0,
     1e9, &S::newton_iterations},
    {"history", "1", "pairs of steps and gradients kept by L-BFGS; 0 is plain quasi-Newton", 0, 1000, &S::history},
    {"max_line_search", "1", "trials allowed in one line search", 1, 1000, &S::max_line_search},
    {"precision", "1", "back end cpu: 0 double; 1 mixed, float for matrices and history only; 2 float", 0, 2,
     &S::precision},
    {"threads", "1", "back end cpu: threads; 0 is OMP_NUM_THREADS, or one where that is not set", 0, 4096, &S::threads},
    {"matrix", "1",
     "back end cpu, quasi-Newton matrix: 0 chosen for each cell, 1 scalar weights, 2 Hessian of the rest shape", 0, 2,
     &S::matrix},
    {"lone_cells", "1", "back end cpu: 1 puts the elements of one cell into the SIMD lanes instead of many cells", 0, 1,
     &S::lone_cells},
    {"lineage_alpha", "1", "lineage Calpha: share of the non-rigid velocity removed in each step", 0, 1,
     &S::lineage_alpha},
    {"lineage_beta", "us", "lineage Cbeta: damping proportional to the weight matrix", 0, infinity, &S::lineage_beta},
    {"lineage_tolerance", "1", "lineage: relative scatter of the objective at which the iterations stop", 0, infinity,
     &S::lineage_tolerance},
    {"lineage_window", "1", "lineage: number of objective values in that scatter", 2, 1000, &S::lineage_window},
    {"lineage_attempts", "1", "lineage: failed line searches allowed in a step", 1, 1e9, &S::lineage_attempts},
    {"lineage_armijo", "1", "lineage gamma: sufficient decrease", 0, 1, &S::lineage_armijo},
    {"lineage_curvature", "1", "lineage gamma2: curvature condition", 0, 1, &S::lineage_curvature},
}};

const OptionInfo& find(std::string_view key) {
  for (const OptionInfo& option : table) {
    if (key == option.key) return option;
  }
  std::vector<std::string> keys;
  for (const OptionInfo& option : table) keys.emplace_back(option.key);
  throw Error(Status::unknown_name, "no option \"" + std::string(key) + "\"" + text::suggestion(key, keys));
}

void require_in_range(const OptionInfo& option, double value) {
  const bool whole = std::holds_alternative<int SolverOptions::*>(option.member);
  if (!(value >= option.least && value <= option.largest) || (whole && value != std::floor(value))) {
    throw Error(Status::bad_input, "option \"" + std::string(option.key) + "\" = " + text::format_number(value) + " " +
                                       option.unit + ": allowed are " + (whole ? "whole " : "") + "numbers from " +
                                       text::format_number(option.least) + " to " +
                                       text::format_number(option.largest));
  }
}

}  // namespace

std::span<const OptionInfo> solver_options() {
  return table;
}

double get_option(const SolverOptions& options, std::string_view key) {
  return std::visit([&](auto member) { return static_cast<double>(options.*member); }, find(key).member);
}

void set_option(SolverOptions& options, std::string_view key, double value) {
  const OptionInfo& option = find(key);
  require_in_range(option, value);
  std::visit(
      [&](auto member) { options.*member = static_cast<std::remove_reference_t<decltype(options.*member)>>(value); },
      option.member);
}

void require_valid(const SolverOptions& options) {
  for (const OptionInfo& option : table) require_in_range(option, get_option(options, option.key));
}

}  // namespace npfem
