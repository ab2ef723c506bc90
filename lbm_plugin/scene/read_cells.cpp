// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <filesystem>

#include "geometry/vec3.h"
#include "nearest.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

using text::Key;
using text::Table;

void read_positions(const Table& table, int type, CellsRequest& request) {
  for (const Table& entry : table.tables("positions")) {
    const Vec3 centre = entry.vector3(keys::centre);
    request.positions.push_back({type, centre, rotation_about_xyz(entry.vector3(keys::rotate))});
    request.position_tables.push_back(entry);
  }
}

void read_number_of_cells(const Table& table, const Scene& scene, CellsRequest& request) {
  const std::vector<CellsRequest>& before = scene.requests;
  const bool listed = table.has("positions");
  if (listed) {
    if (!scene.cells_file.empty()) {
      table.fail("positions", "\"placement.file\" says where the cells start; give only one of them");
    }
    refuse(table, {&keys::haematocrit, &keys::count, &keys::ratio, &keys::ratio_to},
           "\"positions\" is given too; give only one of them");
    read_positions(table, static_cast<int>(before.size()), request);
    return;
  }
  const Key* number = one_of(table, {&keys::haematocrit, &keys::count, &keys::ratio});
  if (!number && !scene.cells_file.empty()) return;
  if (!number) table.fail("one of \"haematocrit\", \"count\", \"ratio\" or \"positions\" is needed");
  if (number != &keys::ratio) refuse(table, {&keys::ratio_to}, "needs \"ratio\" beside it");
  if (number == &keys::haematocrit) request.haematocrit = table.quantity(keys::haematocrit);
  if (number == &keys::count) request.count = within(table, keys::count, 0, 10000000);
  if (number != &keys::ratio) return;
  request.ratio = table.quantity(keys::ratio);
  const std::string other = table.text(keys::ratio_to);
  std::vector<std::string> names;
  for (const CellsRequest& earlier : before) names.push_back(earlier.name);
  const auto found = std::find(names.begin(), names.end(), other);
  if (found == names.end()) {
    table.fail("ratio_to", "no type \"" + other + "\" stands before this one" + text::suggestion(other, names));
  }
  request.ratio_to = static_cast<int>(found - names.begin());
}

}  // namespace

CellsRequest read_cells(const text::Table& table, const Scene& scene, const std::filesystem::path& folder) {
  CellsRequest request(table);
  request.name = table.text(keys::name);
  if (request.name.empty() || request.name.find_first_of(",\"\n\r") != std::string::npos) {
    table.fail("name", "must not be empty, nor hold a comma, a quote or a line break");
  }
  for (const CellsRequest& earlier : scene.requests) {
    if (earlier.name == request.name) table.fail("name", "another type is called \"" + request.name + "\" already");
  }
  request.interior_viscosity_ratio = table.quantity(keys::interior_viscosity_ratio);
  for (const CellsRequest& earlier : scene.requests) {
    const double ratio = earlier.interior_viscosity_ratio;
    if (ratio == 1 || request.interior_viscosity_ratio == 1 || ratio == request.interior_viscosity_ratio) continue;
    table.fail("interior_viscosity_ratio", "\"" + earlier.name + "\" has " + text::format_number(ratio) +
                                               "; all types for which it is not 1 must have the same");
  }
  request.pull = table.quantity(keys::pull);
  request.pull_contact = table.quantity(keys::pull_contact);
  if (&exactly_one_of(table, {&keys::material, &keys::body_folder}) == &keys::body_folder) {
    refuse(table, {&keys::mesh, &keys::level}, "\"body_folder\" is given too; it holds a mesh");
    request.body_folder = path_from(table.text(keys::body_folder), folder);
    if (table.has(keys::body_density)) request.body_density = table.quantity(keys::body_density);
    if (table.has(keys::volume_weight)) request.volume_weight = table.quantity(keys::volume_weight);
    read_number_of_cells(table, scene, request);
    return request;
  }
  refuse(table, {&keys::body_density, &keys::volume_weight}, "needs \"body_folder\" beside it");
  request.material = table.text(keys::material);
  request.material_is_file = request.material.find_first_of("./") != std::string::npos;
  if (request.material_is_file) request.material = path_from(request.material, folder);
  if (table.has(keys::mesh)) request.mesh_file = path_from(table.text(keys::mesh), folder);
  if (table.has(keys::level)) {
    if (!request.mesh_file.empty()) table.fail("level", "\"mesh\" is given too; a mesh file has no level");
    request.level = within(table, keys::level, 1, 5);
  }
  read_number_of_cells(table, scene, request);
  return request;
}

}  // namespace npfem::flow
