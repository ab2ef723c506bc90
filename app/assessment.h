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

/// Says how many triangles pass through each other where cells start with given vertices, which nobody has kept apart;
/// empty where there are none. The cells are placed.
std::string warning_of_crossings(const flow::Scene& scene);

void print_limits(const std::vector<flow::Limit>& limits);
nlohmann::ordered_json limits_as_json(const std::vector<flow::Limit>& limits);

}  // namespace npfem::app
