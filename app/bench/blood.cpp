// SPDX-License-Identifier: MPL-2.0
#include "bench/blood.h"

#include <stdexcept>

#include "scene/make_cells.h"

namespace npfem::app::bench {
namespace {

constexpr const char* shear_box = R"(
schema_version = 1
[domain]
kind = "shear_box"
size = ["50 um", "50 um", "50 um"]
dx = "0.5 um"
[fluid]
kinematic_viscosity = "1e-6 m2/s"
tau = 2.0
[flow]
shear_rate = "100 1/s"
start = "developed"
[[cells]]
name = "rbc"
material = "palabos-rbc"
haematocrit = 0.35
[[cells]]
name = "platelet"
material = "palabos-platelet"
ratio = 0.2
ratio_to = "rbc"
[placement]
gap = "0.1 um"
[coupling]
cell_every = 2
[run]
steps = 1
)";

}  // namespace

flow::Scene blood_scene(const std::string& name, const std::vector<std::string>& assignments) {
  std::vector<std::string> changes;
  if (name == "shear25_ht35") {
    changes = {"domain.size=[\"25 um\", \"25 um\", \"25 um\"]"};
  } else if (name == "shear20_ht20") {
    changes = {"domain.size=[\"20 um\", \"20 um\", \"20 um\"]", "cells[0].haematocrit=0.2"};
  } else if (name != "shear50_ht35") {
    throw std::logic_error("no such scene to measure: " + name);
  }
  changes.insert(changes.end(), assignments.begin(), assignments.end());
  flow::Scene scene = flow::parse_scene(shear_box, name, changes);
  flow::make_types(scene);
  flow::place_scene_cells(scene);
  return scene;
}

}  // namespace npfem::app::bench
