// SPDX-License-Identifier: MPL-2.0
#include "bench/blood.h"

#include <stdexcept>

#include "geometry/vec3.h"
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

std::vector<double> start_positions(const flow::Setup& setup, const flow::CellStart& cell) {
  if (!cell.positions.empty()) return cell.positions;
  std::vector<double> positions = setup.types[static_cast<std::size_t>(cell.type)].shape;
  for (std::size_t v = 0; v < positions.size(); v += 3) {
    const flow::Vec3 placed =
        flow::add(cell.centre, flow::rotate(cell.rotation, {positions[v], positions[v + 1], positions[v + 2]}));
    for (std::size_t axis = 0; axis < 3; ++axis) positions[v + axis] = placed[axis];
  }
  return positions;
}

}  // namespace npfem::app::bench
