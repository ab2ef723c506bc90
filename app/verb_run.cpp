// SPDX-License-Identifier: MPL-2.0
// npfem run: a scene from its first step to its last.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include "file.h"
#include "interrupt.h"
#include "output/run_output.h"
#include "output/summary.h"
#include "progress.h"
#include "scene/make_cells.h"
#include "scene/scene.h"
#include "scene_options.h"
#include "session.h"
#include "simulation/simulation.h"

namespace npfem::app {
namespace {

constexpr std::int64_t fluid_check_every = 20;  // steps

struct RunOptions {
  SceneOptions scene;
  std::string folder;
  bool overwrite = false, quiet = false, json = false;
};

/// Reads the scene and places its cells, the same on every rank.
flow::Scene load(Session& session, const SceneOptions& options) {
  std::optional<flow::Scene> scene;
  on_all_ranks(session, [&] {
    scene.emplace(flow::read_scene(options.path, options.assignments));
    flow::make_types(*scene);
    flow::place_scene_cells(*scene);
  });
  return std::move(*scene);
}

void prepare_folder(Session& session, const RunOptions& options, flow::Scene& scene) {
  on_first_rank(session, [&] {
    std::error_code error;
    if (std::filesystem::equivalent(std::filesystem::absolute(options.scene.path).parent_path(), options.folder,
                                    error)) {
      throw text::FileError("output folder \"" + options.folder + "\" is the one the scene lies in; the run would " +
                            "replace it by the resolved scene; choose another folder");
    }
    flow::prepare_output_folder(options.folder, options.overwrite);
    text::write_file(options.folder + "/scene.toml", flow::resolved_text(scene));
  });
}

Progress::Work work_of(Session& session, const flow::Scene& scene, const flow::Simulation& simulation) {
  double nodes = static_cast<double>(simulation.lattice().nodes().fluid_nodes());
  session.communicator.sum(std::span(&nodes, 1));
  return {scene.steps, nodes, static_cast<double>(simulation.cell_count()) / scene.setup.coupling.steps_per_solve};
}

/// Steps until the end, a failure or an interrupt; returns the seconds it took.
double advance(Session& session, const RunOptions& options, const flow::Scene& scene, flow::Simulation& simulation,
               flow::RunOutput& output) {
  Progress progress(session.first() && !options.quiet, work_of(session, scene, simulation));
  output.write_all(simulation);
  const auto must_end = [&] {
    return !simulation.failures().empty() || session.communicator.any(interrupt_requested()) ||
           (simulation.steps_done() % fluid_check_every == 0 && fluid_failed(simulation, session.communicator));
  };
  while (simulation.steps_done() < scene.steps && !must_end()) {
    simulation.step();
    output.write_due(simulation);
    progress.step_done(simulation.steps_done());
  }
  output.write_all(simulation);
  progress.finish(simulation.steps_done());
  return progress.seconds();
}

void print(const flow::Summary& s, const std::string& folder) {
  std::printf("%lld steps, %.6g us, %.1f s: %.3g MLUPS, %.4g cell-steps/s\n", static_cast<long long>(s.steps),
              s.time_us, s.wall_s, s.mlups, s.cell_steps_per_s);
  std::printf("%d cells, haematocrit %.4f, least gap ", s.cells, s.haematocrit);
  std::printf(std::isfinite(s.minimum_gap_um) ? "%.3g um\n" : "none\n", s.minimum_gap_um);
  std::printf("errors: momentum %.2g, volume %.2g, residual %.2g pN\n", s.momentum_error, s.volume_error,
              s.worst_residual_pN);
  std::printf("state %016llx, output in %s\n", static_cast<unsigned long long>(s.state_hash), folder.c_str());
}

/// Unlike before the run, a file that cannot be written is a failure now, not bad input.
void write_summary(Session& session, const std::string& path, const std::string& json) {
  std::string failure;
  if (session.first()) {
    try {
      text::write_file(path, json);
    } catch (const text::FileError& error) {
      failure = error.what();
    }
  }
  session.communicator.agree(failure);
}

void name_failures(const flow::Summary& s) {
  if (s.fluid_failed) {
    std::cerr << "npfem: after step " << s.steps
              << " the fluid is no longer finite: the flow is too fast for this relaxation time; take a finer dx\n";
  }
  for (const flow::CellFailure& failure : s.failures) {
    std::cerr << "npfem: cell " << failure.id << " (" << s.cell_types[static_cast<std::size_t>(failure.type)]
              << ") failed in step " << failure.step << ": " << failure.reason << "\n";
  }
}

int run(Session& session, const RunOptions& options) {
  flow::Scene scene = load(session, options.scene);
  std::optional<flow::Simulation> simulation;
  on_all_ranks(session, [&] { simulation.emplace(scene.setup, session.communicator); });
  prepare_folder(session, options, scene);
  flow::RunOutput output(session.communicator, options.folder, scene);

  catch_interrupts();
  const double seconds = advance(session, options, scene, *simulation, output);
  flow::Summary summary = flow::summarise(scene, *simulation, session.communicator, seconds);
  const bool failure = summary.fluid_failed || !summary.failures.empty();
  summary.interrupted = summary.steps < scene.steps && !failure;
  const std::string json = to_json(summary);
  write_summary(session, options.folder + "/summary.json", json);
  if (session.first()) {
    name_failures(summary);
    if (summary.interrupted) std::cerr << "npfem: interrupted after step " << summary.steps << "\n";
    if (options.json) std::cout << json;
    if (!options.json && !options.quiet) print(summary, options.folder);
  }
  if (failure) return unstable;
  return summary.interrupted ? failed : done;
}

}  // namespace

Action add_run(CLI::App& program) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "run a scene");
  options->scene.add_to(*command);
  command->add_option("-o,--output", options->folder, "folder for the output; made where it is missing")->required();
  command->add_flag("--overwrite", options->overwrite, "replace the run that is in the folder");
  command->add_flag("--quiet", options->quiet, "no progress, no closing lines");
  command->add_flag("--json", options->json, "print the summary as JSON");
  return [options](Session& session) { return run(session, *options); };
}

}  // namespace npfem::app
