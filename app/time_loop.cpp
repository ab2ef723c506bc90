// SPDX-License-Identifier: MPL-2.0
#include "time_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>

#include "checkpoint/run_checkpoints.h"
#include "file.h"
#include "interrupt.h"
#include "output/rheology.h"
#include "output/run_output.h"
#include "output/summary.h"
#include "progress.h"
#include "walltime.h"

namespace npfem::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t fluid_check_every = 20;  // steps

enum class End { complete, unstable, saved, interrupted };

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class TimeLoop {
 public:
  TimeLoop(Session& session, const LoopOptions& options, const Run& run)
      : session_(session),
        run_(run),
        walltime_(options.walltime.empty() ? std::numeric_limits<double>::infinity()
                                           : parse_walltime(options.walltime)),
        output_(session.communicator, run.folder, run.scene, run.resumed_from),
        checkpoints_(session.communicator, run.folder, run.scene, run.resumed_from.value_or(-1)),
        progress_(session.first() && !options.quiet, work()) {}

  End advance();

  double seconds() const { return progress_.seconds(); }
  double wall_s() const { return run_.earlier_wall_s + seconds(); }
  bool checkpoint_failed() const { return checkpoint_failed_; }

 private:
  Progress::Work work() const;
  void steps();
  bool must_end();
  bool fluid_is_due() const;
  Request agreed_request();
  double margin() const;
  void finish();
  void note(const std::string& failure);

  Session& session_;
  Run run_;
  double walltime_;  // s
  flow::RunOutput output_;
  flow::RunCheckpoints checkpoints_;
  Progress progress_;
  double longest_round_ = 0;  // s: one step with its output
  End end_ = End::complete;
  bool checkpoint_failed_ = false;
};

Progress::Work TimeLoop::work() const {
  double nodes = static_cast<double>(run_.simulation.lattice().nodes().fluid_nodes());
  session_.communicator.sum(std::span(&nodes, 1));
  return {run_.scene.steps, nodes, run_.scene.setup.coupling.steps_per_solve, run_.resumed_from.value_or(0)};
}

End TimeLoop::advance() {
  const auto start = Clock::now();
  if (!run_.resumed_from) output_.write_all(run_.simulation);
  longest_round_ = seconds_since(start);
  steps();
  finish();
  progress_.finish(run_.simulation.steps_done(), run_.simulation.cell_count());
  return end_;
}

/// A checkpoint is written after all output of its step, so that a run that goes on from there knows it to be whole.
void TimeLoop::steps() {
  flow::Simulation& simulation = run_.simulation;
  while (simulation.steps_done() < run_.scene.steps) {
    const auto start = Clock::now();
    simulation.step();
    if (must_end() || simulation.steps_done() == run_.scene.steps) return;
    output_.write_due(simulation);
    longest_round_ = std::max(longest_round_, seconds_since(start));
    if (checkpoints_.due(simulation.steps_done())) note(checkpoints_.save(simulation, wall_s()));
    progress_.step_done(simulation.steps_done(), simulation.cell_count());
  }
}

bool TimeLoop::fluid_is_due() const {
  const std::int64_t step = run_.simulation.steps_done();
  return step % fluid_check_every == 0 || checkpoints_.due(step);
}

bool TimeLoop::must_end() {
  const flow::Simulation& simulation = run_.simulation;
  if (!simulation.failures().empty() || (fluid_is_due() && fluid_failed(simulation, session_.communicator))) {
    end_ = End::unstable;
    return true;
  }
  const Request request = agreed_request();
  if (request != Request::none) end_ = request == Request::save ? End::saved : End::interrupted;
  return request != Request::none;
}

/// The clock is that of the first rank.
Request TimeLoop::agreed_request() {
  auto request = static_cast<std::int64_t>(app::request());
  if (session_.first() && seconds_since(run_.job_start) + margin() > walltime_) {
    request = std::max(request, static_cast<std::int64_t>(Request::save));
  }
  session_.communicator.maximum(std::span(&request, 1));
  return static_cast<Request>(request);
}

/// What must be left of the wall time for another step, the last output and the checkpoint: twice what they have taken.
double TimeLoop::margin() const {
  return 2 * (2 * longest_round_ + checkpoints_.seconds(run_.simulation));
}

void TimeLoop::finish() {
  const flow::Simulation& simulation = run_.simulation;
  if (end_ != End::unstable && fluid_failed(simulation, session_.communicator)) end_ = End::unstable;
  output_.write_all(simulation);
  if (end_ == End::unstable) {
    note(checkpoints_.save_failed(simulation, wall_s()));
  } else if (end_ != End::complete || run_.scene.output.checkpoint_every > 0) {
    note(checkpoints_.save(simulation, wall_s()));
  }
}

/// The run goes on without a checkpoint that could not be written; the one before is still there.
void TimeLoop::note(const std::string& failure) {
  if (failure.empty()) return;
  checkpoint_failed_ = true;
  if (session_.first()) {
    std::cerr << "npfem: no checkpoint after step " << run_.simulation.steps_done() << ": " << failure << std::endl;
  }
}

/// "3 cells (2 rbc, 1 platelet; 270.1 um3) have left through openings"
void print_departures(const flow::Summary& s) {
  std::string types;
  double volume = 0;
  for (std::size_t type = 0; type < s.cell_types.size(); ++type) {
    volume += s.volume_left_by_type[type];
    if (s.cells_left_by_type[type] == 0) continue;
    types += (types.empty() ? "" : ", ") + std::to_string(s.cells_left_by_type[type]) + " " + s.cell_types[type];
  }
  std::printf("%d cell%s (%s; %.4g um3) %s left through openings\n", s.cells_left, s.cells_left == 1 ? "" : "s",
              types.c_str(), volume, s.cells_left == 1 ? "has" : "have");
}

void print(const flow::Summary& s, const std::string& folder) {
  std::printf("%lld steps, %.6g us, %.1f s: %.3g MLUPS, %.4g cell-steps/s\n", static_cast<long long>(s.steps),
              s.time_us, s.wall_s, s.mlups, s.cell_steps_per_s);
  std::printf("%d cells, haematocrit %.4f, least gap ", s.cells, s.haematocrit);
  std::printf(std::isfinite(s.minimum_gap_um) ? "%.3g um\n" : "none\n", s.minimum_gap_um);
  if (s.cells_left > 0) print_departures(s);
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

void say_how_it_ended(End end, const flow::Summary& s, const std::string& folder) {
  name_failures(s);
  if (end == End::interrupted) std::cerr << "npfem: interrupted after step " << s.steps << "\n";
  if (end == End::saved) std::cerr << "npfem: stopped after step " << s.steps << "\n";
  if (end == End::interrupted || end == End::saved) {
    std::cerr << "npfem: to go on: npfem resume " << folder << std::endl;
  }
}

int exit_code(End end, bool checkpoint_failed) {
  if (end == End::unstable) return unstable;
  if (checkpoint_failed || end == End::interrupted) return failed;
  return end == End::saved ? saved : done;
}

}  // namespace

void LoopOptions::add_to(CLI::App& command) {
  command.add_option("--walltime", walltime,
                     "time this job has, like 3h30m or 03:30:00: before it is over the state is saved and the exit "
                     "code is 75");
  command.add_flag("--quiet", quiet, "no progress, no closing lines");
  command.add_flag("--json", json, "print the summary as JSON");
}

int carry_out(Session& session, const LoopOptions& options, Run run) {
  catch_signals();
  TimeLoop loop(session, options, run);
  const End end = loop.advance();
  flow::Summary summary = flow::summarise(run.scene, run.simulation, session.communicator, loop.wall_s());
  summary.interrupted = end == End::saved || end == End::interrupted;
  summary.resumed_from = run.resumed_from;
  if (session.first()) summary.rheology = flow::rheology_means(run.folder + "/rheology.csv");
  const std::string json = to_json(summary);
  write_summary(session, run.folder + "/summary.json", json);
  if (session.first()) {
    say_how_it_ended(end, summary, run.folder);
    if (options.json) std::cout << json;
    if (!options.json && !options.quiet) print(summary, run.folder);
  }
  return exit_code(end, loop.checkpoint_failed());
}

}  // namespace npfem::app
