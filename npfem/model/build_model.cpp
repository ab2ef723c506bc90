// SPDX-License-Identifier: MPL-2.0
#include "model/build_model.h"

#include <algorithm>

#include "error.h"
#include "mesh/mesh_check.h"
#include "mesh/stress_free.h"
#include "mesh/topology.h"
#include "model/model_parts.h"
#include "quantity.h"

namespace npfem {
namespace {

/// The shape in which the membrane carries no in-plane stress.
std::vector<Point> stress_free_shape(const TriangleMesh& mesh, const Material& material) {
  const double v = material.get("stress_free_reduced_volume");
  return v > 0 ? oblate_reference(mesh, v).positions : mesh.positions;
}

void add_membrane(Model& model, const Material& material, const std::vector<Point>& stress_free) {
  const std::string& law = material.get_text("membrane_law");
  const double shear = material.get("shear_modulus");
  if ((law == "skalak" || law == "neo_hookean") && !(shear > 0)) {
    throw Error(Status::bad_input, "material \"" + material.name() + "\": membrane_law \"" + law +
                                       "\" needs a positive shear_modulus (uN/m), found " + text::format_number(shear));
  }
  if (law == "skalak") {
    const double c = material.get("skalak_C");
    for (const Triangle& t : model.triangles) add_element<Membrane<Skalak>>(model, t, stress_free, {shear, c});
    model.shear_modulus = shear;
    model.largest_modulus = shear * (1 + 2 * c);
  } else if (law == "neo_hookean") {
    for (const Triangle& t : model.triangles) add_element<Membrane<NeoHookean>>(model, t, stress_free, {shear});
    model.shear_modulus = shear;
    model.largest_modulus = 3 * shear;
  } else if (law == "lineage") {
    if (const double weight = material.get("lineage_membrane_weight"); !(weight > 0)) {
      throw Error(Status::bad_input, "material \"" + material.name() +
                                         "\": membrane_law \"lineage\" needs a positive lineage_membrane_weight "
                                         "(uN/m), found " +
                                         text::format_number(weight) +
                                         ": without it the matrix of the solver does not feel the membrane");
    }
    const LineageSurfaceMaterial::Params<double> params{material.get("lineage_mu"), material.get("lineage_lambda"),
                                                        material.get("lineage_membrane_weight")};
    for (const Triangle& t : model.triangles) {
      add_element<Membrane<LineageSurfaceMaterial>>(model, t, stress_free, params);
    }
    model.shear_modulus = params.lambda / 4;
    model.largest_modulus = params.lambda / 2;
  }
}

void add_local_area(Model& model, const Material& material, const std::vector<Point>& stress_free) {
  const double weight = material.get("local_area_modulus");
  if (weight == 0) return;
  for (const Triangle& t : model.triangles) add_element<Membrane<LineageArea>>(model, t, stress_free, {weight, 1, 1});
  model.largest_modulus = std::max(model.largest_modulus, weight / 2);
}

void add_bending(Model& model, const Material& material, const TriangleMesh& mesh) {
  const std::string& law = material.get_text("bending_law");
  const bool flat = material.get_text("rest_angles") == "flat";
  const double modulus = material.get("bending_modulus"), weight = material.get("lineage_bending_weight");
  for (const Hinge& h : find_hinges(mesh)) {
    if (law == "dihedral" && modulus > 0) {
      add_element<DihedralBending>(model, {h.a, h.b, h.c, h.d}, mesh.positions, {modulus, flat ? 1.0 : 0.0});
    } else if (law == "lineage" && weight > 0) {
      add_element<LineageBending>(model, {h.a, h.b, h.c, h.d}, mesh.positions, {weight, 1, 1});
    }
  }
}

void add_cell_terms(Model& model, const Material& material) {
  if (const double k = material.get("global_area_modulus"); k > 0) {
    cell_term<GlobalArea>(model).emplace(GlobalArea::Params<double>{k});
    model.largest_modulus = std::max(model.largest_modulus, k);
  }
  if (material.get_text("global_volume_form") == "lineage") {
    if (const double k = material.get("lineage_volume_weight"); k > 0) {
      cell_term<LineageVolume>(model).emplace(LineageVolume::Params<double>{k});
    }
  } else if (const double k = material.get("global_volume_modulus"); k > 0) {
    cell_term<GlobalVolume>(model).emplace(GlobalVolume::Params<double>{k});
  }
}

void set_solid_mass(Model& model, const Material& material) {
  const double surface_density = material.get("membrane_density"), density = material.get("solid_density");
  const auto n = static_cast<std::size_t>(model.num_vertices());
  model.solid_mass.resize(n);
  // A solid's mass is shared equally by its vertices, as in the lineage.
  const double share = density * model.rest.volume / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) model.solid_mass[i] = surface_density * model.vertex_area[i] + share;
}

}  // namespace

Model build_model(const TriangleMesh& mesh, const Material& material) {
  require_valid_surface(mesh, "mesh of material \"" + material.name() + "\"");
  Model model;
  model.initial = mesh.positions;
  model.triangles = mesh.triangles;
  const std::vector<Point> stress_free = stress_free_shape(mesh, material);
  add_membrane(model, material, stress_free);
  add_local_area(model, material, stress_free);
  add_bending(model, material, mesh);
  add_cell_terms(model, material);
  model.viscosity = {material.get("membrane_shear_viscosity"), material.get("membrane_dilatational_viscosity")};
  complete_model(model);
  set_solid_mass(model, material);
  if (model.energy_names().empty()) {
    throw Error(Status::bad_input, "material \"" + material.name() +
                                       "\" has no energy: set membrane_law, "
                                       "bending_law or a global modulus");
  }
  return model;
}

}  // namespace npfem
