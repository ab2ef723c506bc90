// SPDX-License-Identifier: MPL-2.0
#include <cmath>

#include "quantity.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

using text::format_quantity;
using text::Key;
using text::Table;

constexpr int least_nodes = 4;
constexpr int largest_nodes = 100000;

int nodes_along(const Table& table, const Key& key, double length, double dx) {
  const double exact = length / dx;
  if (exact > largest_nodes) {
    table.fail(key.name, format_quantity(length, "um") + " is more than " + std::to_string(largest_nodes) +
                             " node spacings (dx = " + format_quantity(dx, "um") + ")");
  }
  const int nodes = static_cast<int>(std::lround(exact));
  if (std::abs(exact - nodes) > 1e-6) {
    table.fail(key.name, format_quantity(length, "um") +
                             " is not a whole number of node spacings (dx = " + format_quantity(dx, "um") +
                             "); the nearest that are: " + format_quantity(std::floor(exact) * dx, "um") + " and " +
                             format_quantity(std::ceil(exact) * dx, "um"));
  }
  if (nodes < least_nodes) {
    table.fail(key.name, format_quantity(length, "um") + " is only " + std::to_string(nodes) + " node spacings (dx = " +
                             format_quantity(dx, "um") + "); at least " + std::to_string(least_nodes) + " are needed");
  }
  return nodes;
}

void read_vessel(const Table& table, Domain& domain, const std::filesystem::path& folder) {
  const std::string directions = table.has(keys::periodic) ? table.choice(keys::periodic) : "none";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    domain.vessel_periodic[axis] = directions != "none" && directions.find("xyz"[axis]) != std::string::npos;
  }
  domain.solids.emplace_back(read_surface(table, domain, folder, true));
}

void read_kind(const Table& table, Domain& domain) {
  const std::string kind = table.choice(keys::kind);
  if (kind == "tube") domain.kind = DomainKind::tube;
  if (kind == "shear_box") domain.kind = DomainKind::shear_box;
  if (kind == "plates") domain.kind = DomainKind::plates;
  if (kind == "vessel") domain.kind = DomainKind::vessel;
  if (domain.kind != DomainKind::vessel) {
    refuse(table, {&keys::surface, &keys::surface_unit, &keys::surface_shift, &keys::periodic},
           "only a vessel has this; for an obstacle take [[domain.solids]]");
  }
}

}  // namespace

Domain read_domain(const text::Table& table) {
  Domain domain;
  read_kind(table, domain);
  domain.dx = table.quantity(keys::dx);
  if (domain.kind == DomainKind::tube) {
    refuse(table, {&keys::size}, "a tube has \"diameter\" and \"length\" instead");
    const double diameter = table.quantity(keys::diameter);
    const int across = nodes_along(table, keys::diameter, diameter, domain.dx);
    domain.nodes = {across, across, nodes_along(table, keys::length, table.quantity(keys::length), domain.dx)};
    domain.tube_radius = 0.5 * across * domain.dx;
    return domain;
  }
  refuse(table, {&keys::diameter, &keys::length}, "only a tube has this; give \"size\"");
  const Vec3 size = table.vector3(keys::size);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    domain.nodes[axis] = nodes_along(table, keys::size, size[axis], domain.dx);
  }
  return domain;
}

void read_walls(const text::Table& table, Domain& domain, const std::filesystem::path& folder) {
  if (domain.kind == DomainKind::vessel) read_vessel(table, domain, folder);
  for (const Table& solid : table.tables("solids")) domain.solids.push_back(read_solid(solid, domain, folder));
  domain.share_of_fluid = measured_share_of_fluid(domain);
  if (domain.share_of_fluid < 1e-6) table.fail("the walls leave no room for the fluid");
}

}  // namespace npfem::flow
