// SPDX-License-Identifier: MPL-2.0
#include <algorithm>

#include "file.h"
#include "nearest.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {

using text::Table;

void read_placement(const Table& table, Scene& scene, const std::filesystem::path& folder) {
  if (!table.has(keys::file)) return;
  scene.cells_file = path_from(table.text(keys::file), folder);
  try {
    scene.stored = read_cells_file(scene.cells_file);
  } catch (const text::FileError& error) {
    table.fail(keys::file.name, error.what());
  } catch (const text::InputError& error) {
    table.fail(keys::file.name, error.what());
  }
}

void read_random_placement(const Table& table, Scene& scene) {
  const auto is_listed = [](const CellsRequest& request) { return !request.positions.empty(); };
  if (!scene.requests.empty() && std::all_of(scene.requests.begin(), scene.requests.end(), is_listed)) {
    return refuse(table, {&keys::seed, &keys::gap},
                  "no cell is placed at random, since \"positions\" lists them all; leave this out");
  }
  scene.seed = static_cast<std::uint64_t>(table.integer(keys::seed));
  scene.gap = table.quantity(keys::gap);
}

void match_stored_cells(const Table& placement, Scene& scene) {
  if (scene.cells_file.empty()) return;
  std::vector<std::string> names;
  for (const StoredCells& cells : scene.stored) names.push_back(cells.name);
  std::vector<StoredCells> in_order;
  for (const CellsRequest& request : scene.requests) {
    const auto found = std::find(names.begin(), names.end(), request.name);
    if (found == names.end()) {
      request.table.fail("name", "\"" + scene.cells_file + "\" holds no cells \"" + request.name + "\"" +
                                     text::suggestion(request.name, names, "it holds"));
    }
    in_order.push_back(std::move(scene.stored[static_cast<std::size_t>(found - names.begin())]));
    found->clear();
  }
  for (const std::string& name : names) {
    if (!name.empty()) {
      placement.fail(keys::file.name, "\"" + scene.cells_file + "\" holds cells \"" + name +
                                          "\", of which the scene has no [[cells]] table");
    }
  }
  scene.stored = std::move(in_order);
}

}  // namespace npfem::flow
