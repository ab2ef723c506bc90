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

[[noreturn]] void fail(const Material& material, const std::string& what) {
  throw Error(Status::bad_input, "material \"" + material.name() + "\": " + what);
}

/// The modulus of a law that is nothing without it.
double positive(const Material& material, const char* law_key, const char* key) {
  const double value = material.get(key);
  if (!(value > 0)) {
    fail(material, std::string(law_key) + " \"" + material.get_text(law_key) + "\" needs a positive " + key +
                       " (uN/m), found " + text::format_number(value));
  }
  return value;
}

/// One element of a membrane law on each triangle.
template <class Law>
void cover(Model& model, const std::vector<Point>& stress_free, const typename Law::template Params<double>& params) {
  for (const Triangle& t : model.triangles) add_element<Membrane<Law>>(model, t, stress_free, params);
}

void set_moduli(Model& model, double shear, double largest) {
  model.shear_modulus = shear;
  model.largest_modulus = largest;
}

void add_membrane(Model& model, const Material& material, const std::vector<Point>& stress_free) {
  const std::string& law = material.get_text("membrane_law");
  if (law == "none") return;
  if (law == "lineage") {
    const LineageSurfaceMaterial::Params<double> params{material.get("lineage_mu"), material.get("lineage_lambda"),
                                                        positive(material, "membrane_law", "lineage_membrane_weight")};
    cover<LineageSurfaceMaterial>(model, stress_free, params);
    set_moduli(model, params.lambda / 4, params.lambda / 2);
    return;
  }
  const double shear = positive(material, "membrane_law", "shear_modulus");
  if (law == "skalak") {
    const double c = material.get("skalak_C");
    cover<Skalak>(model, stress_free, {shear, c});
    set_moduli(model, shear, shear * (1 + 2 * c));
  } else if (law == "neo_hookean") {
    cover<NeoHookean>(model, stress_free, {shear});
    set_moduli(model, shear, 3 * shear);
  } else if (law == "yeoh") {
    cover<Yeoh>(model, stress_free, {shear, material.get("yeoh_c3")});
    set_moduli(model, shear, 3 * shear);
  } else {
    const WormLikeChain::Params<double> params{shear, material.get("wlc_rest_ratio")};
    for (const auto& edge : find_edges({model.initial, model.triangles})) {
      add_element<WormLikeChain>(model, edge, stress_free, params);
    }
    set_moduli(model, shear, 2 * shear);
  }
}

void add_local_area(Model& model, const Material& material, const std::vector<Point>& stress_free) {
  const double modulus = material.get("local_area_modulus");
  if (modulus == 0) return;
  if (material.get_text("local_area_form") == "smooth") {
    cover<LocalArea>(model, stress_free, {modulus});
    model.largest_modulus = std::max(model.largest_modulus, modulus);
  } else {
    cover<LineageArea>(model, stress_free, {modulus, 1, 1});
    model.largest_modulus = std::max(model.largest_modulus, modulus / 2);
  }
}

void add_collapse_barrier(Model& model, const Material& material, const std::vector<Point>& stress_free) {
  if (const double modulus = material.get("collapse_modulus"); modulus > 0) {
    cover<CollapseBarrier>(model, stress_free, {modulus});
  }
}

/// Helfrich's energy on the ring of each vertex.
template <class Energy>
void add_curvature_bending(Model& model, const Material& material, const TriangleMesh& mesh) {
  const bool flat = material.get_text("rest_angles") == "flat";
  const double curvature = material.get("spontaneous_curvature");
  if (!flat && curvature != 0) {
    fail(material,
         "spontaneous_curvature = " + text::format_quantity(curvature, "1/um") +
             " needs rest_angles \"flat\"; with \"shape\" the initial shape says what curvature is preferred");
  }
  const auto rings = find_rings(mesh);
  for (std::size_t v = 0; v < rings.size(); ++v) {
    std::vector<int> group{static_cast<int>(v)};
    group.insert(group.end(), rings[v].begin(), rings[v].end());
    if (group.size() > static_cast<std::size_t>(Energy::max_vertices)) {
      fail(material, "bending_law \"" + material.get_text("bending_law") + "\" allows at most " +
                         std::to_string(Energy::max_vertices - 1) + " neighbours of a vertex; vertex " +
                         std::to_string(v) + " of the mesh has " + std::to_string(rings[v].size()));
    }
    add_group<Energy>(model, group, mesh.positions, {material.get("bending_modulus"), curvature, flat ? 1.0 : 0.0});
  }
}

void add_bending(Model& model, const Material& material, const TriangleMesh& mesh) {
  const std::string& law = material.get_text("bending_law");
  const double modulus = material.get("bending_modulus"), weight = material.get("lineage_bending_weight");
  if (law == "lineage" && weight > 0) {
    for (const Hinge& h : find_hinges(mesh)) {
      add_element<LineageBending>(model, {h.a, h.b, h.c, h.d}, mesh.positions, {weight, 1, 1});
    }
  } else if (law == "dihedral" && modulus > 0) {
    const bool flat = material.get_text("rest_angles") == "flat";
    for (const Hinge& h : find_hinges(mesh)) {
      add_element<DihedralBending>(model, {h.a, h.b, h.c, h.d}, mesh.positions, {modulus, flat ? 1.0 : 0.0});
    }
  } else if (law == "juelicher" && modulus > 0) {
    add_curvature_bending<JuelicherBending>(model, material, mesh);
  } else if (law == "cotangent" && modulus > 0) {
    add_curvature_bending<CotangentBending>(model, material, mesh);
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
  add_collapse_barrier(model, material, stress_free);
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
