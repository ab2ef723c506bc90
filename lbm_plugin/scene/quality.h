// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "toml_reader.h"

namespace npfem::flow {

/// What a scene that names a `quality` leaves out of resolution, time step, kernel and precision: set as by --set, so
/// that the resolved scene shows it. What the scene gives itself stays. The values come from the diagrams of error
/// against time in docs/speed_and_error.md.
void apply_quality(text::Document& document);

}  // namespace npfem::flow
