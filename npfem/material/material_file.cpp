// SPDX-License-Identifier: MPL-2.0
// Materials from and to TOML:
//   schema_version = 1, name, description
//   [mesh]        shape, level, diameter: the mesh the material is usually put on
//   [parameters]  the keys of Material::params() and text_params(), numbers with their units
//   [sources]     for a key of [parameters], where its value comes from
#include <vector>

#include "error.h"
#include "file.h"
#include "material/material.h"
#include "material/presets.h"
#include "mesh/generate.h"
#include "nearest.h"
#include "toml_reader.h"

namespace npfem {
namespace {

using text::Key;
using text::Kind;

constexpr int schema_version = 1;

constexpr Key version_key{.name = "schema_version", .kind = Kind::integer, .doc = "version of this file format: 1"};
constexpr Key name_key{.name = "name", .kind = Kind::text, .doc = "name of the material"};
constexpr Key description_key{.name = "description", .kind = Kind::text, .fallback = "\"\"", .doc = "one paragraph"};

constexpr Key mesh_keys[] = {
    {.name = "shape",
     .kind = Kind::choice,
     .choices = "rbc platelet sphere icosphere",
     .fallback = "sphere",
     .doc = "shape of the cell"},
    {.name = "level",
     .kind = Kind::integer,
     .range = text::Range::non_negative,
     .fallback = "3",
     .doc = "number of subdivisions, 0 to 8 (a red cell of level 3 has 258 vertices)"},
    {.name = "diameter",
     .dimension = text::Dimension::length(),
     .range = text::Range::non_negative,
     .fallback = "0 um",
     .doc = "largest diameter; 0 is the natural one of the shape"},
};

Key key_of(const ParamInfo& info) {
  return {.name = info.key, .dimension = info.dimension, .fallback = text::optional, .doc = info.doc};
}

Key key_of(const TextParamInfo& info) {
  return {.name = info.key, .kind = Kind::choice, .choices = info.words, .fallback = text::optional, .doc = info.doc};
}

MeshRecipe read_recipe(const text::Table& table) {
  const std::int64_t level = table.integer(mesh_keys[1]);
  if (level > max_mesh_level) table.fail("level", "must lie between 0 and " + std::to_string(max_mesh_level));
  return {table.choice(mesh_keys[0]), static_cast<int>(level), table.quantity(mesh_keys[2])};
}

void read_parameters(const text::Table& table, Material& material) {
  for (const ParamInfo& info : Material::params()) {
    if (!table.has(info.key)) continue;
    const double value = table.quantity(key_of(info));
    try {
      material.set(info.key, value);
    } catch (const Error& error) {
      table.fail(info.key, error.what());
    }
  }
  for (const TextParamInfo& info : Material::text_params()) {
    if (table.has(info.key)) material.set_text(info.key, table.choice(key_of(info)));
  }
}

std::map<std::string, std::string, std::less<>> read_sources(const text::Table& table) {
  std::map<std::string, std::string, std::less<>> sources;
  const auto read = [&](const char* key) {
    if (table.has(key)) sources[key] = table.text({.name = key, .kind = Kind::text});
  };
  for (const ParamInfo& info : Material::params()) read(info.key);
  for (const TextParamInfo& info : Material::text_params()) read(info.key);
  return sources;
}

std::string line(const std::string& key, const std::string& value) {
  return key + " = " + value + '\n';
}

const PresetText& preset_of(std::string_view name) {
  for (const PresetText& preset : preset_texts()) {
    if (name == preset.name) return preset;
  }
  throw Error(Status::unknown_name,
              "unknown material \"" + std::string(name) + '"' + text::suggestion(name, Material::preset_names()));
}

}  // namespace

Material Material::from_toml(std::string_view toml, const std::string& name) {
  try {
    const text::Document document = text::Document::parse_text(toml, name);
    const text::Table root = document.root();
    if (root.integer(version_key) != schema_version) root.fail("schema_version", "this version of npfem reads 1");
    Material material;
    material.name_ = root.text(name_key);
    material.description_ = root.text(description_key);
    material.mesh_ = read_recipe(root.table("mesh"));
    read_parameters(root.table("parameters"), material);
    material.sources_ = read_sources(root.table("sources"));
    root.finish();
    return material;
  } catch (const text::InputError& error) {
    throw Error(Status::bad_input, error.what());
  }
}

Material Material::from_file(const std::string& path) {
  try {
    return from_toml(text::read_file(path), path);
  } catch (const text::FileError& error) {
    throw Error(Status::io, error.what());
  }
}

std::string Material::to_toml() const {
  std::string out = line("schema_version", std::to_string(schema_version)) + line("name", text::toml_string(name_)) +
                    line("description", text::toml_string(description_));
  out += "\n[mesh]\n" + line("shape", text::toml_string(mesh_.shape)) + line("level", std::to_string(mesh_.level)) +
         line("diameter", text::toml_string(text::format_quantity(mesh_.diameter, "um")));
  out += "\n[parameters]\n";
  for (const TextParamInfo& info : text_params()) {
    if (is_given(info.key)) out += line(info.key, text::toml_string(get_text(info.key)));
  }
  for (const ParamInfo& info : params()) {
    if (!is_given(info.key)) continue;
    const std::string value = text::format_quantity(get(info.key), info.unit());
    out += line(info.key, info.dimension.is_none() ? value : text::toml_string(value));
  }
  out += "\n[sources]\n";
  for (const auto& [key, source] : sources_) out += line(key, text::toml_string(source));
  return out;
}

Material Material::preset(std::string_view name) {
  const PresetText& preset = preset_of(name);
  return from_toml(preset.toml, "materials/" + std::string(preset.name) + ".toml");
}

std::vector<std::string> Material::preset_names() {
  std::vector<std::string> names;
  for (const PresetText& preset : preset_texts()) names.push_back(preset.name);
  return names;
}

std::string Material::preset_text(std::string_view name) {
  return preset_of(name).toml;
}

std::string Material::reference_page() {
  std::vector<Key> keys;
  for (const TextParamInfo& info : text_params()) {
    keys.push_back(key_of(info));
    keys.back().fallback = info.fallback;
  }
  std::vector<std::string> fallbacks;
  fallbacks.reserve(params().size());
  for (const ParamInfo& info : params()) {
    fallbacks.push_back(text::format_quantity(info.fallback, info.unit()));
    keys.push_back(key_of(info));
    keys.back().fallback = fallbacks.back().c_str();
  }
  return "### `[parameters]`\n\n" + text::markdown_table(keys) + "\n### `[mesh]`\n\n" + text::markdown_table(mesh_keys);
}

}  // namespace npfem
