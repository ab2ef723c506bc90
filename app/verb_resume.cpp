// SPDX-License-Identifier: MPL-2.0
// npfem resume: goes on with a run from its newest whole checkpoint.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "checkpoint/cell_section.h"
#include "checkpoint/run_checkpoints.h"
#include "file.h"
#include "quantity.h"
#include "run_lock.h"
#include "scene/make_cells.h"
#include "scene/memory_need.h"
#include "scene/scene.h"
#include "session.h"
#include "simulation/agreed_backend.h"
#include "simulation/simulation.h"
#include "time_loop.h"
#include "walltime.h"

namespace npfem::app {
namespace {

struct ResumeOptions {
  std::string folder;
  std::vector<std::string> assignments;
  bool any_instruction_set = false;
  LoopOptions loop;

  std::string scene_file() const { return folder + "/scene.toml"; }
};

void require_harmless(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) {
    if (assignment.starts_with("run.") || assignment.starts_with("output.")) continue;
    throw text::InputError("--set " + assignment +
                           ": only [run] and [output] of a run can be changed when it goes on, as in --set "
                           "run.steps=1000; for anything else start a new run");
  }
}

void require_same_scene(const ResumeOptions& options, const flow::FoundCheckpoint& found, flow::Scene& scene) {
  const std::string tables = flow::differences(found.header.scene, flow::scene_marks(scene));
  if (tables.empty()) return;
  throw text::InputError(found.file->path().string() + " is of another scene than " + options.scene_file() +
                         ": not the same in " + tables +
                         "; put back the scene.toml that the run wrote, and the files that it names");
}

void require_same_types(const flow::FoundCheckpoint& found, const flow::Setup& setup) {
  const std::string types = flow::differences(found.header.types, flow::type_marks(setup));
  if (types.empty()) return;
  throw text::InputError(found.file->path().string() + ": the material, mesh or body of the cells " + types +
                         " is not what it was; put back the files that the run was started with");
}

/// The instruction set of the checkpoint: another one gives other bits.
std::string backend_for(Session& session, const ResumeOptions& options, const std::string& saved) {
  if (!options.any_instruction_set) {
    try {
      return flow::agreed_backend(session.communicator, saved);
    } catch (const std::invalid_argument& error) {
      throw text::InputError(std::string("the checkpoint was written with an instruction set that is not here: ") +
                             error.what() +
                             "; resume on such a machine, or add --allow-other-instruction-set and accept that the "
                             "last bits differ from those of a run that never stopped");
    }
  }
  const std::string here = flow::agreed_backend(session.communicator, "cpu");
  if (here != saved && session.first()) {
    std::cerr << "npfem: goes on with " << here << " instead of " << saved
              << ": the last bits may differ from those of a run that never stopped\n";
  }
  return here;
}

void load_cells(const flow::FoundCheckpoint& found, flow::Scene& scene, double share) {
  flow::make_types(scene);
  require_same_types(found, scene.setup);
  flow::require_memory(scene, flow::cell_counts(scene), share, flow::machine_memory());
  scene.setup.cells = flow::load_placed(*found.file);
  for (const flow::CellStart& cell : scene.setup.cells) {
    if (cell.type >= 0 && cell.type < std::ssize(scene.setup.types)) continue;
    throw text::InputError(found.file->path().string() + ": has a cell of a type that the scene does not have");
  }
}

/// From here on no other job changes what is in the folder.
std::unique_ptr<RunLock> lock_folder(Session& session, const ResumeOptions& options) {
  on_first_rank(session, [&] {
    if (std::filesystem::exists(options.scene_file())) return;
    throw text::FileError("there is no run to go on with: \"" + options.scene_file() + "\" does not exist");
  });
  return lock_run(session, options.folder);
}

flow::FoundCheckpoint find(Session& session, const ResumeOptions& options) {
  flow::FoundCheckpoint found = flow::newest_checkpoint(session.communicator, options.folder);
  if (session.first()) {
    for (const std::string& refusal : found.refused) std::cerr << "npfem: refused: " << refusal << "\n";
    std::cerr << "npfem: resumes after step " << found.header.step << " from " << found.file->path().string()
              << std::endl;
  }
  return found;
}

int resume(Session& session, const ResumeOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (!options.loop.walltime.empty()) parse_walltime(options.loop.walltime);
  require_harmless(options.assignments);
  const auto lock = lock_folder(session, options);
  std::optional<flow::Scene> scene;
  on_all_ranks(session, [&] { scene.emplace(flow::read_scene(options.scene_file(), options.assignments)); });
  const flow::FoundCheckpoint found = find(session, options);
  on_all_ranks(session, [&] { require_same_scene(options, found, *scene); });
  scene->setup.backend = backend_for(session, options, found.header.backend);
  const double share = share_on_this_machine(session);
  on_all_ranks(session, [&] { load_cells(found, *scene, share); });
  std::optional<flow::Simulation> simulation;
  on_all_ranks(session, [&] {
    try {
      simulation.emplace(scene->setup, session.communicator, *found.file, found.header);
    } catch (const std::runtime_error& error) {  // of a file that the scene names, like an STL: its content has changed
      throw text::InputError(error.what());
    }
  });
  if (simulation->steps_done() > scene->steps) {
    throw text::InputError("the run has come to step " + std::to_string(simulation->steps_done()) + ", beyond the " +
                           std::to_string(scene->steps) + " that are asked for");
  }
  on_first_rank(session, [&] { text::write_file(options.scene_file(), flow::resolved_text(*scene)); });
  return carry_out(session, options.loop,
                   {*scene, *simulation, options.folder, simulation->steps_done(), found.header.wall_s, start});
}

}  // namespace

Action add_resume(CLI::App& program) {
  const auto options = std::make_shared<ResumeOptions>();
  CLI::App* command = program.add_subcommand("resume", "go on with a run from its newest checkpoint");
  command->add_option("folder", options->folder, "output folder of the run")->required();
  command
      ->add_option("--set", options->assignments,
                   "change a value of [run] or [output]: --set run.steps=1000 (may be repeated)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--allow-other-instruction-set", options->any_instruction_set,
                    "go on where the instruction set of the checkpoint is missing; the last bits then differ");
  options->loop.add_to(*command);
  return [options](Session& session) { return resume(session, *options); };
}

}  // namespace npfem::app
