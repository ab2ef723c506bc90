// SPDX-License-Identifier: MPL-2.0
#include "contact/contacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace npfem::flow {

Contacts::Contacts(const Setup& setup) : domain_(setup.domain), box_pairs_(setup.domain) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (domain_.periodic()[axis]) period_[axis] = domain_.size()[axis];
  }
  for (const CellType& type : setup.types) surfaces_.emplace_back(type.shape, type.triangles);
  for (const CellStart& cell : setup.cells) type_of_.push_back(static_cast<std::size_t>(cell.type));
  take_laws(setup.contact);
  for (const ContactLaw& law : laws_) reach_ = std::max(reach_, law.reach());
  for (const ContactLaw& law : wall_laws_) wall_reach_ = std::max(wall_reach_, law.reach());
  skin_ = 0.2 * std::max(reach_, wall_reach_);
}

void Contacts::take_laws(const ContactSettings& settings) {
  const std::size_t types = surfaces_.size();
  laws_.assign(types * types, settings.cells);
  wall_laws_.assign(types, settings.walls);
  for (const PairContact& pair : settings.pairs) {
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    if (pair.second == PairContact::wall) {
      wall_laws_[a] = pair.law;
    } else {
      laws_[a * types + b] = laws_[b * types + a] = pair.law;
    }
  }
  for (std::size_t a = 0; a < types; ++a) {
    require_sound(wall_laws_[a], 2 * surfaces_[a].largest_area(), "with walls");
    for (std::size_t b = 0; b < types; ++b) require_sound(law(a, b), surfaces_[a].largest_area(), "between cells");
  }
}

void Contacts::require_sound(const ContactLaw& law, double area, const std::string& between) const {
  const auto refuse = [&](const std::string& what) { throw std::invalid_argument("contact " + between + ": " + what); };
  for (const double value : {law.range, law.strength, law.depth, law.width}) {
    if (!(value >= 0 && std::isfinite(value))) {
      refuse("range " + std::to_string(law.range) + " um, strength " + std::to_string(law.strength) +
             " Pa, attraction " + std::to_string(law.depth) + " uN/m over " + std::to_string(law.width) +
             " um; none may be negative or infinite");
    }
  }
  if (!law.active()) return;
  if (law.depth > 0 && !(law.width > 0)) refuse("an attraction needs a width above 0 um");
  const double force = 0.5 * area * std::max(law.traction(-law.range), law.depth > 0 ? law.depth / law.width : 0);
  const double stiffness = area * std::max(law.slope(-law.range), law.slope(law.range));
  if (force < largest_contact_force && stiffness < largest_contact_stiffness) return;
  refuse("the force on a vertex could reach " + std::to_string(force) + " pN with a stiffness of " +
         std::to_string(stiffness) + " pN/um; allowed are less than 8192 pN and 8.6e9 pN/um: lower strength or depth");
}

void Contacts::evaluate(const ContactVertices& vertices, std::span<ContactLoad> loads) {
  vertices_ = &vertices;
  std::fill(loads.begin(), loads.end(), ContactLoad{});
  force_of_walls_ = {};
  finding_ = {0, reach_};
  if (!active()) return;
  if (!lists_hold()) make_lists();
  search();
  for (const Part& part : parts_) {
    for (const Hit& hit : part.hits) apply(hit, loads);
  }
  if (wall_reach_ > 0) push_from_walls(loads);
}

/// Equal and opposite to the last bit: the third corner takes what the other two leave.
void Contacts::apply(const Hit& hit, std::span<ContactLoad> loads) {
  ++finding_.contacts;
  finding_.least_distance = std::min(finding_.least_distance, hit.distance);
  ContactLoad on_vertex, left;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    on_vertex.force[axis] = fixed_force(hit.force[axis]);
    left.force[axis] = -on_vertex.force[axis];
  }
  on_vertex.stiffness = left.stiffness = fixed_stiffness(hit.stiffness);
  loads[static_cast<std::size_t>(hit.vertex)].add(on_vertex);
  for (std::size_t c = 0; c < 2; ++c) {
    ContactLoad share;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      share.force[axis] = -fixed_force(hit.weight[c] * hit.force[axis]);
      left.force[axis] -= share.force[axis];
    }
    share.stiffness = fixed_stiffness(hit.weight[c] * hit.stiffness);
    left.stiffness -= share.stiffness;
    loads[static_cast<std::size_t>(hit.corner[c])].add(share);
  }
  left.stiffness = std::max<std::int64_t>(left.stiffness, 0);
  loads[static_cast<std::size_t>(hit.corner[2])].add(left);
}

void Contacts::push_from_walls(std::span<ContactLoad> loads) {
  for (const Cell& cell : cells_) {
    if (!cell.near_wall) continue;
    const ContactLaw& its = wall_laws_[cell.type];
    for (std::size_t v = cell.first_vertex; v < cell.last_vertex; ++v) {
      if (!is_held_[v]) continue;
      const WallDistance wall = domain_.wall_distance(position(static_cast<std::int32_t>(v)));
      if (!(wall.distance < its.reach())) continue;
      const double area = surfaces_[cell.type].area(static_cast<std::size_t>(vertices_->id[v].vertex));
      ContactLoad load;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        load.force[axis] = fixed_force(area * its.traction(wall.distance) * wall.normal[axis]);
        force_of_walls_[axis] += load.force[axis];
      }
      load.stiffness = fixed_stiffness(area * its.slope(wall.distance));
      loads[v].add(load);
    }
  }
}

Vec3 Contacts::force_of_walls() const {
  return {force_of(force_of_walls_[0]), force_of(force_of_walls_[1]), force_of(force_of_walls_[2])};
}

}  // namespace npfem::flow
