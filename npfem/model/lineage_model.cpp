// SPDX-License-Identifier: MPL-2.0
#include "model/lineage_model.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "model/model_parts.h"
#include "quantity.h"

namespace npfem {
namespace {

struct LineageType {
  const char* name;
  LineageArity arity;
};

constexpr LineageType types[] = {{"SurfaceMaterial", {3, 5}},
                                 {"Area", {3, 2}},
                                 {"Bending", {4, 2}},
                                 {"Volume", {4, 2}},
                                 {"VolumeMaterial", {4, 5}},
                                 {"TriangleARAP", {3, 0}},
                                 {"TetrahedronARAP", {4, 0}},
                                 {"EdgeStrainLimiting", {2, 2}},
                                 {"TriangleStrainLimiting", {3, 2}},
                                 {"TetrahedronStrainLimiting", {4, 2}}};

std::string place_of(const LineageConstraint& c, std::size_t index) {
  return "constraint " + std::to_string(index) + " (" + c.type + "): ";
}

template <class E>
void add(Model& model, const LineageElement& element, std::size_t index,
         const typename E::template Params<double>& params) {
  std::array<int, E::num_vertices> ids;
  Vec3<double> x[E::num_vertices];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = element.constraint.ids[i];
    x[i] = as_vec3(element.rest[i]);
  }
  const auto rest = E::rest(x, params);
  // A rest shape is plain numbers.
  const auto* numbers = reinterpret_cast<const double*>(&rest);
  if (!std::all_of(numbers, numbers + sizeof rest / sizeof(double), [](double v) { return std::isfinite(v); })) {
    throw Error(Status::bad_input, place_of(element.constraint, index) +
                                       "at rest its vertices lie on one point, line or plane; its edges, triangles and "
                                       "tetrahedra need a length, an area and a volume");
  }
  auto& block = model.block<E>();
  block.vertices.push_back(ids);
  block.params.push_back(params);
  block.rest.push_back(rest);
}

void require_buildable(const LineageConstraint& c, std::size_t index, std::size_t points) {
  const LineageArity arity = lineage_arity(c.type);
  const std::string where = place_of(c, index);
  if (arity.ids == 0) {
    throw Error(Status::bad_input, where + "this type is not available; there are " + lineage_types());
  }
  if (c.ids.size() != static_cast<std::size_t>(arity.ids) ||
      c.scalars.size() != static_cast<std::size_t>(arity.scalars)) {
    throw Error(Status::bad_input, where + "needs " + std::to_string(arity.ids) + " vertices and " +
                                       std::to_string(arity.scalars) + " scalars, found " +
                                       std::to_string(c.ids.size()) + " and " + std::to_string(c.scalars.size()));
  }
  for (const int id : c.ids) {
    if (id < 0 || static_cast<std::size_t>(id) >= points) {
      throw Error(Status::bad_input,
                  where + "vertex " + std::to_string(id) + " does not exist; there are " + std::to_string(points));
    }
  }
}

void add_constraint(Model& model, const LineageElement& element, std::size_t index) {
  const LineageConstraint& c = element.constraint;
  const double w = c.weight;
  const double least = c.scalars.empty() ? 1 : c.scalars[0], largest = c.scalars.empty() ? 1 : c.scalars[1];
  const auto surface_modulus = [&model](double modulus) {
    model.largest_modulus = std::max(model.largest_modulus, modulus);
  };
  if (c.type == "SurfaceMaterial") {
    add<Membrane<LineageSurfaceMaterial>>(model, element, index, {c.scalars[2], c.scalars[3], w});
    model.triangles.push_back({c.ids[0], c.ids[1], c.ids[2]});
    model.shear_modulus = std::max(model.shear_modulus, c.scalars[3] / 4);
    surface_modulus(c.scalars[3] / 2);
  } else if (c.type == "Area") {
    add<Membrane<LineageArea>>(model, element, index, {w, least, largest});
    surface_modulus(w / 2);
  } else if (c.type == "Bending") {
    add<LineageBending>(model, element, index, {w, least, largest});
  } else if (c.type == "TriangleARAP") {
    add<Membrane<TriangleArap>>(model, element, index, {w});
    surface_modulus(w);
  } else if (c.type == "TriangleStrainLimiting") {
    add<Membrane<TriangleStrainLimit>>(model, element, index, {w, least, largest});
    surface_modulus(w);
  } else if (c.type == "EdgeStrainLimiting") {
    add<EdgeStrainLimit>(model, element, index, {w, least, largest});
  } else if (c.type == "TetrahedronARAP") {
    add<Tetrahedron<TetrahedronArap>>(model, element, index, {w});
  } else if (c.type == "TetrahedronStrainLimiting") {
    add<Tetrahedron<TetrahedronStrainLimit>>(model, element, index, {w, least, largest});
  } else {  // Volume, and VolumeMaterial, whose three further scalars have no effect in the lineage either
    add<Tetrahedron<TetrahedronVolume>>(model, element, index, {w, least, largest});
  }
}

}  // namespace

LineageArity lineage_arity(const std::string& type) {
  for (const LineageType& known : types) {
    if (type == known.name) return known.arity;
  }
  return {0, 0};
}

std::string lineage_types() {
  std::string list;
  for (const LineageType& known : types) list += (list.empty() ? "" : ", ") + std::string(known.name);
  return list;
}

Model build_lineage_model(const std::vector<Point>& points, const std::vector<LineageElement>& elements,
                          const LineageMass& mass) {
  Model model;
  model.initial = points;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    require_buildable(elements[i].constraint, i, points.size());
    add_constraint(model, elements[i], i);
  }
  complete_model(model);
  if (!(model.rest.volume > 0)) {
    throw Error(Status::bad_input, "the SurfaceMaterial triangles enclose a volume of " +
                                       text::format_number(model.rest.volume) +
                                       " um3; a closed surface, counter-clockwise seen from "
                                       "outside, is needed");
  }
  if (mass.volume_weight > 0)
    cell_term<LineageVolume>(model).emplace(LineageVolume::Params<double>{mass.volume_weight});
  model.solid_mass.assign(points.size(), mass.density * model.rest.volume / static_cast<double>(points.size()));
  return model;
}

Model build_lineage_model(const LineageBody& body, const LineageMass& mass) {
  std::vector<LineageElement> elements;
  elements.reserve(body.constraints.size());
  for (const LineageConstraint& constraint : body.constraints) {
    LineageElement element{constraint, {}};
    for (std::size_t i = 0; i < std::min<std::size_t>(constraint.ids.size(), 4); ++i) {
      const auto id = static_cast<std::size_t>(constraint.ids[i]);
      if (id < body.surface.positions.size()) element.rest[i] = body.surface.positions[id];
    }
    elements.push_back(element);
  }
  return build_lineage_model(body.surface.positions, elements, mass);
}

}  // namespace npfem
