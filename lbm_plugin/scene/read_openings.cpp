// SPDX-License-Identifier: MPL-2.0
#include "quantity.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

using text::Table;

Face read_face(const Table& table, const Domain& domain) {
  const std::string word = table.choice(keys::face);
  const std::size_t axis = std::string("xyz").find(word[0]);
  const auto face = static_cast<Face>(2 * axis + (word[1] == '+' ? 1 : 0));
  const bool between_plates = domain.kind == DomainKind::plates && axis == 1;
  const bool around_tube = domain.kind == DomainKind::tube && axis < 2;
  if (between_plates || around_tube) table.fail("face", "\"" + word + "\" is a wall of this kind of domain");
  if (domain.opening_of_face()[static_cast<std::size_t>(face)] >= 0) {
    table.fail("face", "\"" + word + "\" has an opening already");
  }
  return face;
}

Opening read_opening(const Table& table, const Domain& domain) {
  Opening opening;
  opening.face = read_face(table, domain);
  if (table.choice(keys::opening_kind) == "pressure") {
    refuse(table, {&keys::velocity, &keys::profile}, "an opening of the kind \"pressure\" has none");
    if (table.has(keys::pressure)) opening.pressure = table.quantity(keys::pressure);
    return opening;
  }
  refuse(table, {&keys::pressure}, "an opening of the kind \"velocity\" has none");
  opening.kind = Opening::Kind::velocity;
  opening.mean_velocity = table.quantity(keys::velocity);
  if (table.has(keys::profile) && table.choice(keys::profile) == "plug") opening.profile = Opening::Profile::plug;
  return opening;
}

void read_axis(const Table& flow, Domain& domain) {
  if (!flow.has(keys::axis)) return;
  const std::string axis = flow.choice(keys::axis);
  if (domain.kind == DomainKind::tube && axis != "z") flow.fail("axis", "a tube lies along z");
  const bool between_plates = domain.kind == DomainKind::shear_box || domain.kind == DomainKind::plates;
  if (between_plates && axis == "y") flow.fail("axis", "the plates stand across y; x or z are allowed");
  domain.plate_axis = static_cast<int>(std::string("xyz").find(axis));
}

}  // namespace

void read_openings(const Table& root, Domain& domain) {
  read_axis(root.table("flow"), domain);
  bool has_velocity = false, has_pressure = false;
  const std::vector<Table> tables = root.tables("openings");
  for (const Table& table : tables) {
    if (domain.kind == DomainKind::shear_box) table.fail("a shear box has no openings; take the kind plates");
    domain.openings.push_back(read_opening(table, domain));
    const bool by_velocity = domain.openings.back().kind == Opening::Kind::velocity;
    has_velocity = has_velocity || by_velocity;
    has_pressure = has_pressure || !by_velocity;
  }
  if (has_velocity && !has_pressure) {
    tables.front().fail(
        "an inlet without an outlet: what flows in at a given velocity must leave somewhere; add an "
        "opening of the kind \"pressure\"");
  }
}

}  // namespace npfem::flow
