// SPDX-License-Identifier: MPL-2.0
#include "scene/make_cells.h"

#include <cmath>
#include <filesystem>
#include <numeric>

#include "file.h"
#include "geometry/cell_shape.h"
#include "geometry/tweezers_load.h"
#include "geometry/vec3.h"
#include "placement/place_cells.h"
#include "scene/read_parts.h"

namespace npfem::flow {
namespace {

api::Material material_of(const CellsRequest& request) {
  return request.material_is_file ? api::Material::load(request.material) : api::Material::preset(request.material);
}

api::Mesh mesh_of(const CellsRequest& request, const api::Material& material) {
  return request.mesh_file.empty() ? material.mesh(request.level) : api::Mesh::load(request.mesh_file);
}

std::string text_of(const api::Material& material) {
  return api::text_of(
      [&](char* b, std::int32_t n) { return api::check(npfem_material_to_text(material.handle(), b, n)); });
}

/// The unloaded cell about the origin: at rest under its own forces, whatever shape its mesh had.
std::vector<double> relaxed_shape(const api::Model& model, const CellsRequest& request, const std::string& backend) {
  api::Batch cell(model, backend, 1);
  if (cell.relax() > 0) {
    request.table.fail("material",
                       "a cell \"" + request.name + "\" left alone does not come to rest: " + cell.status_text(0));
  }
  std::vector<double> xyz(3 * static_cast<std::size_t>(model.vertices()));
  cell.read("position", 0, 1, xyz);
  const Vec3 centre = shape_of(xyz, model.triangles()).centre;
  for (std::size_t n = 0; n < xyz.size(); ++n) xyz[n] -= centre[n % 3];
  return xyz;
}

void require_valid_options(const api::Model& model, const Scene& scene) {
  api::Batch none(model, scene.setup.backend, 0);
  for (const auto& [key, value] : scene.solver_options) none.set(key, value);
}

/// What a body of Palabos-npFEM is made of, as text: its files whole, since only they know the weights of its energies.
std::string record_of_body(const CellsRequest& request) {
  std::string record = "body folder, density " + text::format_quantity(request.body_density, "kg/m3") +
                       ", volume weight " + text::format_quantity(request.volume_weight, "uN/m") + '\n';
  for (const char* file : {"points.csv", "surface_connectivity.csv", "constraints.csv", "onSurfaceParticle.csv"}) {
    record += text::read_file((std::filesystem::path(request.body_folder) / file).string());
  }
  return record;
}

/// `peskin` takes the forces of the energies where the cell is; a membrane's viscosity needs where it was.
void require_known_to_coupling(const api::Material& material, const CellsRequest& request, CouplingScheme scheme) {
  if (scheme != CouplingScheme::peskin) return;
  for (const char* key : {"membrane_shear_viscosity", "membrane_dilatational_viscosity"}) {
    if (material.number(key) == 0) continue;
    request.table.fail("material", "has a " + std::string(key) +
                                       " above 0, which coupling.scheme = \"peskin\" does not know; take \"implicit\", "
                                       "or a material without it");
  }
}

/// `source` names the key to blame where the next call fails; `record` is what the type is made of, as text.
api::Model model_of(const CellsRequest& request, CouplingScheme scheme, const char*& source, std::string& record) {
  if (!request.body_folder.empty()) {
    source = "body_folder";
    api::Model model = api::Model::load_lineage(request.body_folder, request.body_density, request.volume_weight);
    record = record_of_body(request);
    return model;
  }
  const api::Material material = material_of(request);
  record = text_of(material);
  require_known_to_coupling(material, request, scheme);
  if (!request.mesh_file.empty()) source = "mesh";
  const api::Mesh mesh = mesh_of(request, material);
  source = "material";
  return {mesh, material};
}

std::vector<double> load_of(const CellsRequest& request, std::span<const double> shape) {
  if (!(request.pull > 0)) return {};
  std::vector<double> load = tweezers_load(shape, request.pull, request.pull_contact);
  if (load.empty()) {
    request.table.fail("pull_contact", text::format_quantity(request.pull_contact, "um") +
                                           " is so narrow that no vertex lies under it at one end of a cell; take a "
                                           "wider one or a finer mesh");
  }
  return load;
}

CellType make_type(const CellsRequest& request, const Scene& scene) {
  const char* source = "material";
  std::string record;
  try {
    const auto model =
        std::make_shared<const api::Model>(model_of(request, scene.setup.coupling.scheme, source, record));
    require_valid_options(*model, scene);
    std::vector<double> shape = relaxed_shape(*model, request, scene.setup.backend);
    std::vector<double> load = load_of(request, shape);
    return {request.name,
            model,
            std::move(shape),
            model->triangles(),
            scene.solver_options,
            record,
            request.interior_viscosity_ratio,
            std::move(load)};
  } catch (const api::Failure& failure) {
    request.table.fail(source, failure.what());
  }
}

double volume_of(const CellType& type) {
  return enclosed_volume(type.shape, type.triangles);
}

}  // namespace

void make_types(Scene& scene) {
  for (const CellsRequest& request : scene.requests) scene.setup.types.push_back(make_type(request, scene));
}

std::vector<int> cell_counts(const Scene& scene) {
  const double volume = scene.setup.domain.fluid_volume();
  std::vector<int> counts;
  for (std::size_t type = 0; type < scene.requests.size(); ++type) {
    if (!scene.cells_file.empty()) {
      counts.push_back(scene.stored[type].count());
      continue;
    }
    const CellsRequest& request = scene.requests[type];
    auto count = static_cast<double>(request.positions.size());
    if (request.haematocrit) count = *request.haematocrit * volume / volume_of(scene.setup.types[type]);
    if (request.count) count = *request.count;
    if (request.ratio) count = *request.ratio * counts[static_cast<std::size_t>(request.ratio_to)];
    if (count > 1e7) request.table.fail("asks for more than ten million cells");
    counts.push_back(static_cast<int>(std::lround(count)));
    if (request.haematocrit && *request.haematocrit > 0 && counts.back() == 0) {
      const double one = volume_of(scene.setup.types[type]) / volume;
      request.table.fail("haematocrit", text::format_number(*request.haematocrit) +
                                            " is less than half a cell in this domain; one cell is a haematocrit of " +
                                            text::format_number(one));
    }
  }
  return counts;
}

namespace {

std::string at_place(const Vec3& p) {
  std::string text = "(";
  for (std::size_t axis = 0; axis < 3; ++axis) text += (axis > 0 ? ", " : "") + text::format_number(rounded(p[axis]));
  return text + ") um";
}

/// A cell that starts across a wall would be torn: the fluid beyond it does not move with the rest.
void require_inside(const Scene& scene, const CellStart& cell, int number) {
  const Domain& domain = scene.setup.domain;
  for (std::size_t v = 0; v < cell.positions.size() / 3; ++v) {
    const Vec3 point = vector_at(cell.positions, v);
    if (domain.distance_for_cells(point).distance > 0) continue;
    scene.document.root()
        .table("placement")
        .fail("file", "cell " + std::to_string(number) + " (" +
                          scene.setup.types[static_cast<std::size_t>(cell.type)].name + ") at " +
                          at_place(cell.centre) + " reaches beyond a wall, or too near to an opening, at " +
                          at_place(point));
  }
}

void place_stored_cells(Scene& scene) {
  for (std::size_t type = 0; type < scene.stored.size(); ++type) {
    const StoredCells& stored = scene.stored[type];
    const CellType& its = scene.setup.types[type];
    if (stored.vertices != its.model->vertices() || stored.mesh_hash != hash_of_mesh(its.triangles)) {
      scene.requests[type].table.fail("the cells \"" + stored.name + "\" in \"" + scene.cells_file +
                                      "\" have another mesh (" + std::to_string(stored.vertices) +
                                      " vertices) than this type (" + std::to_string(its.model->vertices()) +
                                      "): take the material and mesh they were made with");
    }
    for (int n = 0; n < stored.count(); ++n) {
      const auto xyz = stored.cell(n);
      const Vec3 centre = shape_of(xyz, its.triangles).centre;
      scene.setup.cells.push_back({static_cast<int>(type), centre, identity_rotation, {xyz.begin(), xyz.end()}});
      require_inside(scene, scene.setup.cells.back(), static_cast<int>(scene.setup.cells.size()) - 1);
    }
  }
}

}  // namespace

PlacementReport place_scene_cells(Scene& scene) {
  if (!scene.cells_file.empty()) {
    place_stored_cells(scene);
    return {};
  }
  PlacementRequest request;
  request.counts = cell_counts(scene);
  request.gap = scene.gap;
  request.seed = scene.seed;
  std::vector<text::Table> tables;
  for (std::size_t type = 0; type < scene.requests.size(); ++type) {
    const CellsRequest& cells = scene.requests[type];
    request.given.insert(request.given.end(), cells.positions.begin(), cells.positions.end());
    tables.insert(tables.end(), cells.position_tables.begin(), cells.position_tables.end());
    if (!cells.positions.empty()) request.counts[type] = 0;
  }
  try {
    Placement placement = place_cells(scene.setup.domain, scene.setup.types, request);
    scene.setup.cells = std::move(placement.cells);
    return {placement.grown, placement.sweeps};
  } catch (const PlacementError& error) {
    if (error.given_cell() >= 0) tables[static_cast<std::size_t>(error.given_cell())].fail(error.what());
    scene.document.root().table("placement").fail(error.what());
  }
}

std::vector<double> haematocrit_by_type(const Setup& setup, const std::vector<int>& counts) {
  std::vector<double> shares;
  for (std::size_t type = 0; type < counts.size(); ++type) {
    shares.push_back(counts[type] * volume_of(setup.types[type]) / setup.domain.fluid_volume());
  }
  return shares;
}

}  // namespace npfem::flow
