// SPDX-License-Identifier: MPL-2.0
// Walls inside the box: obstacles, narrow places, surfaces from STL files.
#include <algorithm>
#include <cmath>

#include "file.h"
#include "geometry/surface_check.h"
#include "quantity.h"
#include "scene/memory_need.h"
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

using text::format_quantity;
using text::Key;
using text::Table;

constexpr double least_nodes_across = 3;  // of a passage: fewer do not carry a flow

/// Refuses the keys that belong to other shapes.
void require_only(const Table& table, const std::string& shape, std::initializer_list<const Key*> own) {
  for (const Key* key : {&keys::solid_centre, &keys::solid_size, &keys::solid_diameter, &keys::at, &keys::solid_length,
                         &keys::width, &keys::depth, &keys::surface, &keys::surface_unit, &keys::surface_shift}) {
    if (std::find(own.begin(), own.end(), key) == own.end() && table.has(*key)) {
      table.fail(key->name, "a solid of the shape \"" + shape + "\" has none");
    }
  }
}

double narrower_than(const Table& table, const Key& key, double room, double dx) {
  const double value = table.quantity(key);
  if (value >= room) {
    table.fail(key.name, format_quantity(value, "um") + " is not less than the " + format_quantity(room, "um") +
                             " that the domain has there");
  }
  if (value < least_nodes_across * dx) {
    table.fail(key.name, format_quantity(value, "um") + " is less than three node spacings (dx = " +
                             format_quantity(dx, "um") + "); take a finer dx");
  }
  return value;
}

/// Middle of the section of the box at the place along the flow.
Vec3 middle_at(const Table& table, const Domain& domain) {
  Vec3 centre = scale(0.5, domain.size());
  const std::size_t along = domain.flow_axis();
  if (table.has(keys::at)) centre[along] = table.quantity(keys::at);
  if (centre[along] < 0 || centre[along] > domain.size()[along]) {
    table.fail("at", format_quantity(centre[along], "um") + " is outside of the box, which ends at " +
                         format_quantity(domain.size()[along], "um"));
  }
  return centre;
}

double passage_length(const Table& table, const Domain& domain) {
  const double length = table.quantity(keys::solid_length);
  const double room = domain.size()[domain.flow_axis()];
  if (length > room) {
    table.fail("length", format_quantity(length, "um") + " is more than the " + format_quantity(room, "um") +
                             " of the box along the flow");
  }
  return length;
}

Slit read_slit(const Table& table, const Domain& domain) {
  require_only(table, "slit", {&keys::at, &keys::solid_length, &keys::width, &keys::depth});
  const std::size_t along = domain.flow_axis();
  if (along == 1) table.fail("shape", "the width of a slit is along y; the flow must not be");
  Slit::Shape shape{static_cast<int>(along),
                    1,
                    middle_at(table, domain),
                    passage_length(table, domain),
                    narrower_than(table, keys::width, domain.size()[1], domain.dx),
                    {}};
  if (table.has(keys::depth)) {
    shape.depth = narrower_than(table, keys::depth, domain.size()[2 - along], domain.dx);
  }
  return Slit(shape, domain.size());
}

Constriction read_constriction(const Table& table, const Domain& domain) {
  require_only(table, "constriction", {&keys::at, &keys::solid_length, &keys::width});
  const bool round = domain.kind == DomainKind::tube;
  if (!round && domain.kind != DomainKind::plates) {
    table.fail("shape", "a constriction narrows a tube or plates; this domain is neither");
  }
  const double wide = round ? 2 * domain.tube_radius : domain.size()[1];
  const double width = narrower_than(table, keys::width, wide, domain.dx);
  return Constriction({static_cast<int>(domain.flow_axis()), round, middle_at(table, domain),
                       passage_length(table, domain), 0.5 * wide, 0.5 * width});
}

}  // namespace

SurfaceSolid read_surface(const Table& table, const Domain& domain, const std::filesystem::path& folder,
                          bool fluid_inside) {
  const std::string path = path_from(table.text(keys::surface), folder);
  TriangleSurface surface;
  try {
    surface = read_stl(path);
  } catch (const text::FileError& error) {
    table.fail("surface", error.what());
  } catch (const text::InputError& error) {
    table.fail("surface", error.what());
  }
  if (const double need = surface_memory(domain); need > machine_memory()) {
    table.fail("surface", "its distances at all nodes of the box would take " +
                              text::format_number(rounded(1e-9 * need)) + " GB, and this machine has " +
                              text::format_number(rounded(1e-9 * machine_memory())) + " GB: take a larger dx");
  }
  const double unit = table.quantity(keys::surface_unit);
  const Vec3 shift = table.vector3(keys::surface_shift);
  for (Vec3& vertex : surface.vertices) vertex = add(scale(unit, vertex), shift);
  SurroundingBox box{domain.size(), {}, 1e-3 * domain.dx};
  const std::array<bool, 3> periodic = domain.periodic();
  const std::array<int, 6> opening = domain.opening_of_face();
  for (std::size_t face = 0; face < 6; ++face) {
    box.open[face] = fluid_inside && (periodic[face / 2] || opening[face] >= 0);
  }
  drop_lids(surface, box);
  const auto refuse_surface = [&](const std::string& fault) { table.fail("surface", "\"" + path + "\" " + fault); };
  if (const std::string fault = fault_of(surface, box); !fault.empty()) refuse_surface(fault);
  const double volume = volume_inside(surface, box);
  if (std::abs(volume) < std::pow(domain.dx, 3)) refuse_surface("encloses less than one cell of the lattice");
  if (volume < 0) turn_over(surface);
  return SurfaceSolid(surface, {domain.nodes, domain.dx, periodic}, fluid_inside);
}

Solid read_solid(const Table& table, const Domain& domain, const std::filesystem::path& folder) {
  const std::string shape = table.choice(keys::shape);
  if (shape == "slit") return read_slit(table, domain);
  if (shape == "constriction") return read_constriction(table, domain);
  if (shape == "surface") {
    require_only(table, shape, {&keys::surface, &keys::surface_unit, &keys::surface_shift});
    return read_surface(table, domain, folder, false);
  }
  if (shape == "sphere") {
    require_only(table, shape, {&keys::solid_centre, &keys::solid_diameter});
    return SphereSolid{table.vector3(keys::solid_centre), 0.5 * table.quantity(keys::solid_diameter)};
  }
  require_only(table, shape, {&keys::solid_centre, &keys::solid_size});
  return BoxSolid{table.vector3(keys::solid_centre), scale(0.5, table.vector3(keys::solid_size))};
}

}  // namespace npfem::flow
