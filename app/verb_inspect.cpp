// SPDX-License-Identifier: MPL-2.0
// npfem inspect: what is in a mesh, a material, a scene or the output of a run.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include "file.h"
#include "nearest.h"
#include "quantity.h"
#include "session.h"
#include "toml_reader.h"

namespace npfem::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> presets() {
  std::vector<std::string> names;
  const int count = api::check(npfem_material_preset_count());
  for (int i = 0; i < count; ++i) {
    names.push_back(
        api::text_of([&](char* b, std::int32_t n) { return api::check(npfem_material_preset_name(i, b, n)); }));
  }
  return names;
}

void show(const api::Mesh& mesh) {
  std::cout << "mesh: " << mesh.vertices() << " vertices, " << mesh.triangles() << " triangles\n";
  for (const char* key :
       {"area", "volume", "reduced_volume", "extent_x", "extent_y", "extent_z", "edge_min", "edge_mean", "edge_max"}) {
    std::cout << "  " << key << " = " << mesh.measure(key) << "\n";
  }
}

void show(const api::Material& material) {
  std::cout << api::text_of(
      [&](char* b, std::int32_t n) { return api::check(npfem_material_to_text(material.handle(), b, n)); });
}

void show_folder(const fs::path& folder) {
  std::map<std::string, int> files;  // by ending
  for (const auto& entry : fs::directory_iterator(folder)) ++files[entry.path().extension().string()];
  std::cout << folder.string() << ":";
  for (const auto& [ending, count] : files) std::cout << " " << count << " " << (ending.empty() ? "other" : ending);
  std::cout << "\n";
  const fs::path summary = folder / "summary.json";
  if (fs::exists(summary)) {
    std::cout << text::read_file(summary.string());
  } else {
    std::cout << "no summary.json: not the output of a finished run\n";
  }
}

void show_toml(const std::string& path) {
  const text::Document document = text::Document::parse_file(path);
  if (document.root().has("domain")) {
    std::cout << "scene (npfem plan " << path << " says what it computes):\n" << text::read_file(path);
  } else {
    show(api::Material::load(path));
  }
}

int inspect(const std::string& what) {
  const std::vector<std::string> names = presets();
  if (fs::is_directory(what)) {
    show_folder(what);
  } else if (what.ends_with(".toml")) {
    show_toml(what);
  } else if (std::find(names.begin(), names.end(), what) != names.end()) {
    show(api::Material::preset(what));
  } else if (fs::exists(what)) {
    show(api::Mesh::load(what));
  } else {
    throw text::InputError("\"" + what + "\" is neither a file, nor a folder, nor a material preset" +
                           text::suggestion(what, names, "presets"));
  }
  return done;
}

}  // namespace

Action add_inspect(CLI::App& program) {
  const auto what = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("inspect", "show what is in a mesh, material, scene or output folder");
  command->add_option("what", *what, "a file, a folder, or the name of a material preset")->required();
  return [what](Session& session) { return session.first() ? inspect(*what) : static_cast<int>(done); };
}

}  // namespace npfem::app
