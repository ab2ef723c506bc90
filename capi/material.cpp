// SPDX-License-Identifier: MPL-2.0
// Materials: presets, files, text. Their numbers and words go by key (parameters.cpp).
#include "material/material.h"

#include <string>

#include "arguments.h"
#include "guard.h"
#include "handle_table.h"
#include "mesh/generate.h"
#include "npfem/npfem.h"

namespace npfem::capi {
namespace {

std::int32_t add_material(Material material) {
  return add_object(std::make_shared<MaterialObject>(std::move(material)));
}

/// A copy, so that no lock is held while it is used.
Material copy_of(std::int32_t material) {
  return *wait_for(find_object<MaterialObject>(material));
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem;
using namespace npfem::capi;

int32_t npfem_material_preset_count(void) {
  return guard(__func__, [&] { return as_count(Material::preset_names().size()); });
}

int32_t npfem_material_preset_name(int32_t index, char* buffer, int32_t capacity) {
  return guard(__func__, [&] {
    const std::vector<std::string> names = Material::preset_names();
    return text_out(names[require_index(index, names.size(), "preset")], buffer, capacity);
  });
}

int32_t npfem_material_preset(const char* name) {
  return guard(__func__, [&] { return add_material(Material::preset(text_argument(name, "name"))); });
}

int32_t npfem_material_load(const char* path) {
  return guard(__func__, [&] { return add_material(Material::from_file(std::string(text_argument(path, "path")))); });
}

int32_t npfem_material_parse(const char* toml_text) {
  return guard(__func__, [&] {
    return add_material(Material::from_toml(text_argument(toml_text, "toml_text"), "material text"));
  });
}

int32_t npfem_material_to_text(int32_t material, char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(copy_of(material).to_toml(), buffer, capacity); });
}

int32_t npfem_material_mesh(int32_t material, int32_t level) {
  return guard(__func__, [&] {
    const MeshRecipe recipe = copy_of(material).mesh();
    const int chosen = level < 0 ? recipe.level : level;
    return add_object(std::make_shared<MeshObject>(generate_mesh(recipe.shape, chosen, recipe.diameter)));
  });
}
