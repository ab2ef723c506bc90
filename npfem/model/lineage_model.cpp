// SPDX-License-Identifier: MPL-2.0
#include "model/lineage_model.h"

#include <algorithm>

#include "error.h"
#include "model/model_parts.h"
#include "quantity.h"

namespace npfem {
namespace {

template <class E>
void add(Model& model, const LineageElement& element, const typename E::template Params<double>& params) {
  std::array<int, E::num_vertices> ids;
  Vec3<double> x[E::num_vertices];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = element.constraint.ids[i];
    x[i] = as_vec3(element.rest[i]);
  }
  auto& block = model.block<E>();
  block.vertices.push_back(ids);
  block.params.push_back(params);
  block.rest.push_back(E::rest(x, params));
}

void require_buildable(const LineageConstraint& c, std::size_t index, std::size_t points) {
  const LineageArity arity = lineage_arity(c.type);
  const std::string where = "constraint " + std::to_string(index) + " (" + c.type + "): ";
  if (arity.ids == 0) {
    throw Error(Status::bad_input, where +
                                       "this type is not available; there are "
                                       "SurfaceMaterial, Area, Bending");
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

void add_constraint(Model& model, const LineageElement& element) {
  const LineageConstraint& c = element.constraint;
  if (c.type == "SurfaceMaterial") {
    add<Membrane<LineageSurfaceMaterial>>(model, element, {c.scalars[2], c.scalars[3], c.weight});
    model.triangles.push_back({c.ids[0], c.ids[1], c.ids[2]});
    model.shear_modulus = std::max(model.shear_modulus, c.scalars[3] / 4);
    model.largest_modulus = std::max(model.largest_modulus, c.scalars[3] / 2);
  } else if (c.type == "Area") {
    add<Membrane<LineageArea>>(model, element, {c.weight, c.scalars[0], c.scalars[1]});
    model.largest_modulus = std::max(model.largest_modulus, c.weight / 2);
  } else {
    add<LineageBending>(model, element, {c.weight, c.scalars[0], c.scalars[1]});
  }
}

}  // namespace

LineageArity lineage_arity(const std::string& type) {
  if (type == "SurfaceMaterial") return {3, 5};
  if (type == "Area") return {3, 2};
  if (type == "Bending") return {4, 2};
  return {0, 0};
}

Model build_lineage_model(const std::vector<Point>& points, const std::vector<LineageElement>& elements,
                          const LineageMass& mass) {
  Model model;
  model.initial = points;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    require_buildable(elements[i].constraint, i, points.size());
    add_constraint(model, elements[i]);
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
