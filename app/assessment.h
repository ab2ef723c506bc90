// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "coupling/limits.h"
#include "scene/scene.h"

namespace npfem::app {

/// The accuracy limits of a scene whose types are made, with the flow it imposes.
std::vector<flow::Limit> limits_of(const flow::Scene& scene);

/// What the scene asks for and may not mean: that of reading it, and cells that start through each other where nobody
/// has kept them apart. The cells are placed.
std::vector<std::string> warnings_of(const flow::Scene& scene);

void print_limits(const std::vector<flow::Limit>& limits);
nlohmann::ordered_json limits_as_json(const std::vector<flow::Limit>& limits);

}  // namespace npfem::app
