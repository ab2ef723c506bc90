// SPDX-License-Identifier: MPL-2.0
// What running and resuming a scene have in common: the steps, what is written on the way, how it ends.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "scene/scene.h"
#include "session.h"
#include "simulation/simulation.h"

namespace npfem::app {

struct LoopOptions {
  bool quiet = false, json = false;
  std::string walltime;

  void add_to(CLI::App& command);
};

/// A run at its first step, or at the step it is resumed from.
struct Run {
  flow::Scene& scene;
  flow::Simulation& simulation;
  std::string folder;
  std::optional<std::int64_t> resumed_from;
  double earlier_wall_s = 0;                        ///< of the jobs before this one
  std::chrono::steady_clock::time_point job_start;  ///< from which the wall time counts
};

/// Steps to the end, a failure, a signal or the end of the wall time, with all output; returns the exit code.
int carry_out(Session& session, const LoopOptions& options, Run run);

}  // namespace npfem::app
