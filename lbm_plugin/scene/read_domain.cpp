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

}  // namespace

Domain read_domain(const text::Table& table) {
  Domain domain;
  const std::string kind = table.choice(keys::kind);
  domain.dx = table.quantity(keys::dx);
  if (kind == "tube") {
    domain.kind = DomainKind::tube;
    refuse(table, {&keys::size}, "a tube has \"diameter\" and \"length\" instead");
    const double diameter = table.quantity(keys::diameter);
    const int across = nodes_along(table, keys::diameter, diameter, domain.dx);
    domain.nodes = {across, across, nodes_along(table, keys::length, table.quantity(keys::length), domain.dx)};
    domain.tube_radius = 0.5 * across * domain.dx;
    return domain;
  }
  domain.kind = kind == "shear_box" ? DomainKind::shear_box
                : kind == "plates"  ? DomainKind::plates
                                    : DomainKind::periodic_box;
  refuse(table, {&keys::diameter, &keys::length}, "only a tube has this; give \"size\"");
  const Vec3 size = table.vector3(keys::size);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    domain.nodes[axis] = nodes_along(table, keys::size, size[axis], domain.dx);
  }
  return domain;
}

}  // namespace npfem::flow
