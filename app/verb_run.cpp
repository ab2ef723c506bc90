// SPDX-License-Identifier: MPL-2.0
// npfem run: a scene from its first step to its last.
#include <filesystem>
#include <iostream>
#include <optional>

#include "assessment.h"
#include "file.h"
#include "output/run_output.h"
#include "run_lock.h"
#include "scene/make_cells.h"
#include "scene/memory_need.h"
#include "scene/scene.h"
#include "scene_options.h"
#include "session.h"
#include "simulation/agreed_backend.h"
#include "simulation/simulation.h"
#include "time_loop.h"
#include "walltime.h"

namespace npfem::app {
namespace {

struct RunOptions {
  SceneOptions scene;
  LoopOptions loop;
  std::string folder;
  bool overwrite = false;
};

/// Reads the scene and places its cells, the same on every rank.
flow::Scene load(Session& session, const SceneOptions& options) {
  std::optional<flow::Scene> scene;
  on_all_ranks(session, [&] { scene.emplace(flow::read_scene(options.path, options.assignments)); });
  scene->setup.backend = flow::agreed_backend(session.communicator, scene->setup.backend);
  const double share = share_on_this_machine(session);
  on_all_ranks(session, [&] {
    flow::make_types(*scene);
    flow::require_memory(*scene, flow::cell_counts(*scene), share, flow::machine_memory());
    flow::place_scene_cells(*scene);
  });
  return std::move(*scene);
}

/// Makes the folder where it is missing, and locks it before anything in it is touched.
std::unique_ptr<RunLock> lock_folder(Session& session, const RunOptions& options) {
  on_first_rank(session, [&] {
    std::error_code error;
    if (std::filesystem::equivalent(std::filesystem::absolute(options.scene.path).parent_path(), options.folder,
                                    error)) {
      throw text::FileError("output folder \"" + options.folder + "\" is the one the scene lies in; the run would " +
                            "replace it by the resolved scene; choose another folder");
    }
    flow::make_output_folder(options.folder);
  });
  return lock_run(session, options.folder);
}

int run(Session& session, const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (!options.loop.walltime.empty()) parse_walltime(options.loop.walltime);
  flow::Scene scene = load(session, options.scene);
  if (session.first()) {
    for (const std::string& warning : warnings_of(scene)) std::cerr << "npfem: " << warning << "\n";
  }
  std::optional<flow::Simulation> simulation;
  on_all_ranks(session, [&] { simulation.emplace(scene.setup, session.communicator); });
  const auto lock = lock_folder(session, options);
  on_first_rank(session, [&] {
    flow::prepare_output_folder(options.folder, options.overwrite);
    text::write_file(options.folder + "/scene.toml", flow::resolved_text(scene));
  });
  return carry_out(session, options.loop, {scene, *simulation, options.folder, {}, 0, start});
}

}  // namespace

Action add_run(CLI::App& program) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "run a scene");
  options->scene.add_to(*command);
  command->add_option("-o,--output", options->folder, "folder for the output; made where it is missing")->required();
  command->add_flag("--overwrite", options->overwrite, "replace the run that is in the folder");
  options->loop.add_to(*command);
  return [options](Session& session) { return run(session, *options); };
}

}  // namespace npfem::app
