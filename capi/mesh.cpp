// SPDX-License-Identifier: MPL-2.0
// Meshes: created, generated, loaded, saved, read and measured.
#include <string>

#include "arguments.h"
#include "error.h"
#include "guard.h"
#include "handle_table.h"
#include "mesh/generate.h"
#include "mesh/geometry.h"
#include "mesh/mesh_check.h"
#include "mesh/read_mesh.h"
#include "nearest.h"
#include "npfem/npfem.h"

namespace npfem::capi {
namespace {

void require_triples(std::int32_t length, const char* name) {
  if (length % 3 != 0) {
    throw Error(Status::bad_argument,
                "the length of " + std::string(name) + " is " + std::to_string(length) + "; allowed: multiples of 3");
  }
}

TriangleMesh mesh_from(std::span<const double> xyz, std::span<const std::int32_t> triangles) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < xyz.size(); i += 3) mesh.positions.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    mesh.triangles.push_back({triangles[i], triangles[i + 1], triangles[i + 2]});
  }
  return mesh;
}

/// A surface becomes an object only when physics can be put on it.
std::int32_t add_surface(TriangleMesh mesh, std::string_view name) {
  require_valid_surface(mesh, name);
  return add_object(std::make_shared<MeshObject>(std::move(mesh)));
}

struct Measure {
  const char* key;
  double (*of)(const TriangleMesh& mesh);
};

constexpr Measure measures[]{
    {"area", surface_area},
    {"volume", signed_volume},
    {"reduced_volume", reduced_volume},
    {"extent_x", [](const TriangleMesh& mesh) { return extents(mesh)[0]; }},
    {"extent_y", [](const TriangleMesh& mesh) { return extents(mesh)[1]; }},
    {"extent_z", [](const TriangleMesh& mesh) { return extents(mesh)[2]; }},
    {"edge_min", [](const TriangleMesh& mesh) { return edge_lengths(mesh).min; }},
    {"edge_mean", [](const TriangleMesh& mesh) { return edge_lengths(mesh).mean; }},
    {"edge_max", [](const TriangleMesh& mesh) { return edge_lengths(mesh).max; }},
};

double measure_mesh(const TriangleMesh& mesh, std::string_view key) {
  std::vector<std::string> keys;
  for (const Measure& measure : measures) {
    if (key == measure.key) return measure.of(mesh);
    keys.emplace_back(measure.key);
  }
  throw Error(Status::unknown_name, "no measure \"" + std::string(key) + "\"" + text::suggestion(key, keys));
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem;
using namespace npfem::capi;

int32_t npfem_mesh_create(const double* xyz, int32_t xyz_length, const int32_t* triangles, int32_t triangles_length) {
  return guard(__func__, [&] {
    const auto positions = array_argument(xyz, xyz_length, "xyz");
    const auto ids = array_argument(triangles, triangles_length, "triangles");
    require_triples(xyz_length, "xyz");
    require_triples(triangles_length, "triangles");
    return add_surface(mesh_from(positions, ids), "in memory");
  });
}

int32_t npfem_mesh_generate(const char* shape, int32_t level, double size) {
  return guard(__func__, [&] {
    const std::string_view name = text_argument(shape, "shape");
    return add_surface(generate_mesh(name, level, size), name);
  });
}

int32_t npfem_mesh_load(const char* path) {
  return guard(__func__, [&] {
    const std::string file(text_argument(path, "path"));
    return add_surface(read_mesh(file), file);
  });
}

int32_t npfem_mesh_save(int32_t mesh, const char* path) {
  return guard(__func__, [&] { write_mesh(std::string(text_argument(path, "path")), *find_object<MeshObject>(mesh)); });
}

int32_t npfem_mesh_vertex_count(int32_t mesh) {
  return guard(__func__, [&] { return as_count(find_object<MeshObject>(mesh)->positions.size()); });
}

int32_t npfem_mesh_triangle_count(int32_t mesh) {
  return guard(__func__, [&] { return as_count(find_object<MeshObject>(mesh)->triangles.size()); });
}

int32_t npfem_mesh_get_positions(int32_t mesh, double* xyz, int32_t length) {
  return guard(__func__, [&] {
    const auto surface = find_object<MeshObject>(mesh);
    const auto out = array_argument(xyz, length, "xyz");
    require_length(length, 3 * surface->positions.size(), "xyz");
    copy_triples(surface->positions, out);
  });
}

int32_t npfem_mesh_get_triangles(int32_t mesh, int32_t* triangles, int32_t length) {
  return guard(__func__, [&] {
    const auto surface = find_object<MeshObject>(mesh);
    const auto out = array_argument(triangles, length, "triangles");
    require_length(length, 3 * surface->triangles.size(), "triangles");
    copy_triples(surface->triangles, out);
  });
}

int32_t npfem_mesh_measure(int32_t mesh, const char* key, double* value) {
  return guard(__func__, [&] {
    const auto surface = find_object<MeshObject>(mesh);
    require_pointer(value, "value");
    *value = measure_mesh(*surface, text_argument(key, "key"));
  });
}
