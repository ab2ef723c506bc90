// SPDX-License-Identifier: MPL-2.0
#include <algorithm>

#include "nearest.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

using text::Key;
using text::Table;

constexpr const char* wall_name = "wall";

/// Folded and crowded cells press on each other with some 20 Pa of their own elastic stress, flow with some times its
/// viscous stress; contacts must bear that within a part of their range. Stiffer ones than need be would move cells
/// that start close together within less than a time step.
double pressure_at_touch(const Scene& scene) {
  constexpr double least = 50, most = 500, stresses = 30;  // Pa, Pa; of the flow
  const double viscosity = scene.setup.density * scene.setup.kinematic_viscosity;
  return std::clamp(stresses * viscosity * scene.flow.shear_rate.value_or(0), least, most);
}

/// Number of the type of that name; PairContact::wall for a wall, where one may stand there.
int type_named(const Table& table, const Key& key, const Scene& scene, bool or_wall) {
  const std::string name = table.text(key);
  std::vector<std::string> names;
  for (const CellsRequest& request : scene.requests) names.push_back(request.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  if (or_wall && name == wall_name) return PairContact::wall;
  if (or_wall) names.emplace_back(wall_name);
  table.fail(key.name, "no type of cells is called \"" + name + "\"" + text::suggestion(name, names));
}

/// An attraction begins where the repulsion ends: without one there is none.
void require_range(const Table& table, const Key& attraction, const ContactLaw& law) {
  if (law.depth == 0 || law.active()) return;
  table.fail(attraction.name,
             "acts beyond \"range\", which is 0 and switches the whole contact off: give a range above 0, or leave the "
             "attraction out");
}

PairContact read_pair(const Table& table, const Scene& scene) {
  PairContact pair{};
  pair.first = type_named(table, keys::first, scene, false);
  pair.second = type_named(table, keys::second, scene, true);
  pair.law = pair.second == PairContact::wall ? scene.setup.contact.walls : scene.setup.contact.cells;
  const auto take = [&](const Key& key, double& value) {
    if (table.has(key)) value = table.quantity(key);
  };
  take(keys::pair_range, pair.law.range);
  take(keys::pair_strength, pair.law.strength);
  take(keys::pair_attraction, pair.law.depth);
  take(keys::pair_attraction_width, pair.law.width);
  if (table.has(keys::pair_attraction)) require_range(table, keys::pair_attraction, pair.law);
  return pair;
}

}  // namespace

void read_contact(const Table& table, Scene& scene) {
  Setup& setup = scene.setup;
  ContactSettings& contact = setup.contact;
  const double width = table.quantity(keys::attraction_width);
  const auto given = [&table](const Key& key, double fallback) {
    return table.has(key) ? table.quantity(key) : fallback;
  };
  const double strength = pressure_at_touch(scene);
  contact.cells = {given(keys::range, setup.domain.dx), given(keys::strength, strength),
                   table.quantity(keys::attraction), width};
  require_range(table, keys::attraction, contact.cells);
  contact.walls = {given(keys::wall_range, setup.domain.dx), given(keys::wall_strength, strength), 0, width};
  for (const Table& entry : table.tables("pairs")) {
    const PairContact pair = read_pair(entry, scene);
    for (const PairContact& earlier : contact.pairs) {
      const bool same = (earlier.first == pair.first && earlier.second == pair.second) ||
                        (earlier.first == pair.second && earlier.second == pair.first);
      if (same) entry.fail("second", "this pair stands there already");
    }
    contact.pairs.push_back(pair);
  }
}

}  // namespace npfem::flow
