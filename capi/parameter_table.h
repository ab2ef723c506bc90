// SPDX-License-Identifier: MPL-2.0
// The parameters of materials and batches as a host sees them: enough to draw a slider or a menu for each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backend/solver_options.h"

namespace npfem::capi {

/// The numbers are part of the C interface (npfem_param_kind).
enum class ParameterKind : int { number = 0, word = 1 };

struct Parameter {
  std::string key, unit, doc;
  ParameterKind kind = ParameterKind::number;
  double least = 0, largest = 0, fallback = 0;  ///< of a number, in `unit`
};

/// Numbers first, then words; the order never changes within one library.
const std::vector<Parameter>& material_parameters();
const std::vector<Parameter>& batch_parameters();

/// Throws Error(unknown_name) with the nearest key, Error(bad_argument) where the parameter is of the other kind.
void require_parameter(const std::vector<Parameter>& parameters, std::string_view key, ParameterKind kind);

/// The words of a batch: "method" is "default" or "lineage".
std::string get_option_word(const SolverOptions& options);
void set_option_word(SolverOptions& options, std::string_view word);

}  // namespace npfem::capi
