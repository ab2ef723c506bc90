// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>

namespace npfem::app {

/// Seconds of a wall time as people and Slurm write it: "3h30m", "90 min", "1.5 h", "45s", "2d 4h", or "mm:ss",
/// "hh:mm:ss", "d-hh:mm:ss". text::InputError for anything else.
double parse_walltime(const std::string& text);

}  // namespace npfem::app
