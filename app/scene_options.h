// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace npfem::app {

/// The scene file and its changes, as several verbs take them.
struct SceneOptions {
  std::string path;
  std::vector<std::string> assignments;

  void add_to(CLI::App& command) {
    command.add_option("scene", path, "scene file (.toml)")->required();
    command.add_option("--set", assignments, "change a value of the scene: --set run.steps=100 (may be repeated)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
  }
};

}  // namespace npfem::app
