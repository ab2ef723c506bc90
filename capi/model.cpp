// SPDX-License-Identifier: MPL-2.0
// Models: built once, then only read.
#include "model/model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "arguments.h"
#include "error.h"
#include "guard.h"
#include "handle_table.h"
#include "mesh/lineage_body.h"
#include "model/build_model.h"
#include "model/lineage_model.h"
#include "nearest.h"
#include "npfem/npfem.h"
#include "quantity.h"

namespace npfem::capi {
namespace {

std::int32_t add_model(Model model) {
  return add_object(std::make_shared<ModelObject>(std::move(model)));
}

void require_not_negative(double value, const char* name, const char* unit) {
  if (!std::isfinite(value) || value < 0) {
    throw Error(Status::bad_input, std::string(name) + " = " + text::format_quantity(value, unit) +
                                       ": allowed are finite numbers of at least 0");
  }
}

double measure_model(const Model& model, std::string_view key) {
  if (key == "rest_area") return model.rest.area;
  if (key == "rest_volume") return model.rest.volume;
  if (key == "shear_modulus") return model.shear_modulus;
  if (key == "largest_modulus") return model.largest_modulus;
  throw Error(Status::unknown_name,
              "no measure \"" + std::string(key) + "\"" +
                  text::suggestion(key, {"rest_area", "rest_volume", "shear_modulus", "largest_modulus"}));
}

void get_field(const Model& model, std::string_view field, std::span<double> out) {
  const std::string name = "field \"" + std::string(field) + "\"";
  const auto length = static_cast<std::int32_t>(out.size());
  if (field == "rest_position") {
    require_length(length, 3 * model.initial.size(), name);
    copy_triples(model.initial, out);
  } else if (field == "rest_area" || field == "solid_mass") {
    const std::vector<double>& values = field == "rest_area" ? model.vertex_area : model.solid_mass;
    require_length(length, values.size(), name);
    std::copy(values.begin(), values.end(), out.begin());
  } else {
    throw Error(Status::unknown_name,
                "no " + name + text::suggestion(field, {"rest_position", "rest_area", "solid_mass"}));
  }
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem;
using namespace npfem::capi;

int32_t npfem_model_create(int32_t mesh, int32_t material) {
  return guard(__func__, [&] {
    const auto surface = find_object<MeshObject>(mesh);
    const Material copy = *wait_for(find_object<MaterialObject>(material));
    return add_model(build_model(*surface, copy));
  });
}

int32_t npfem_model_load_lineage(const char* folder, double solid_density, double volume_weight) {
  return guard(__func__, [&] {
    const std::string path(text_argument(folder, "folder"));
    require_not_negative(solid_density, "solid_density", "fg/um3");
    require_not_negative(volume_weight, "volume_weight", "pN/um");
    return add_model(build_lineage_model(read_lineage_body(path), {solid_density, volume_weight}));
  });
}

int32_t npfem_model_vertex_count(int32_t model) {
  return guard(__func__, [&] { return as_count(find_object<ModelObject>(model)->initial.size()); });
}

int32_t npfem_model_triangle_count(int32_t model) {
  return guard(__func__, [&] { return as_count(find_object<ModelObject>(model)->triangles.size()); });
}

int32_t npfem_model_get_triangles(int32_t model, int32_t* triangles, int32_t length) {
  return guard(__func__, [&] {
    const auto found = find_object<ModelObject>(model);
    const auto out = array_argument(triangles, length, "triangles");
    require_length(length, 3 * found->triangles.size(), "triangles");
    copy_triples(found->triangles, out);
  });
}

int32_t npfem_model_get(int32_t model, const char* field, double* values, int32_t length) {
  return guard(__func__, [&] {
    const auto found = find_object<ModelObject>(model);
    get_field(*found, text_argument(field, "field"), array_argument(values, length, "values"));
  });
}

int32_t npfem_model_measure(int32_t model, const char* key, double* value) {
  return guard(__func__, [&] {
    const auto found = find_object<ModelObject>(model);
    require_pointer(value, "value");
    *value = measure_model(*found, text_argument(key, "key"));
  });
}

int32_t npfem_model_energy_count(int32_t model) {
  return guard(__func__, [&] { return as_count(find_object<ModelObject>(model)->energy_names().size()); });
}

int32_t npfem_model_energy_name(int32_t model, int32_t index, char* buffer, int32_t capacity) {
  return guard(__func__, [&] {
    const std::vector<std::string> names = find_object<ModelObject>(model)->energy_names();
    return text_out(names[require_index(index, names.size(), "energy")], buffer, capacity);
  });
}
