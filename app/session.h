// SPDX-License-Identifier: MPL-2.0
// What every verb has at hand: the group of processes it runs on, and how it ends.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "communicator/communicator.h"
#include "npfem/npfem.hpp"

namespace npfem::app {

/// What the program answers to the shell.
enum ExitCode : int {
  done = 0,
  failed = 1,     ///< something went wrong that is not the input, or the run was interrupted
  bad_input = 2,  ///< nothing was done
  unstable = 3,   ///< a cell could not be solved; the last state is saved
  saved = 75,     ///< stopped by a signal or the wall time with a checkpoint: npfem resume goes on
};

struct Session {
  flow::Communicator& communicator;
  bool first() const { return communicator.rank() == 0; }  ///< the one rank that prints
};

/// Adds a verb to the command line; what it returns is called when the verb was given.
using Action = std::function<int(Session&)>;
Action add_run(CLI::App& program);
Action add_resume(CLI::App& program);
Action add_pack(CLI::App& program);
Action add_plan(CLI::App& program);
Action add_validate(CLI::App& program);
Action add_mesh(CLI::App& program);
Action add_inspect(CLI::App& program);
Action add_bench(CLI::App& program);
Action add_import(CLI::App& program);
Action add_keys(CLI::App& program);
Action add_version(CLI::App& program);

/// One process, or all that mpirun started.
std::unique_ptr<flow::Communicator> make_communicator(int* argc, char*** argv);

/// True for a call of the cell solver that failed because of what it was given.
bool is_bad_input(const api::Failure& failure);

/// The part of the ranks that run on this machine, between 0 and 1. Collective.
double share_on_this_machine(Session& session);

/// Runs `work` on every rank. Input that one rank cannot use is an InputError on all of them.
void on_all_ranks(Session& session, const std::function<void()>& work);
/// Runs `work` on the first rank only; the others wait and share the outcome.
void on_first_rank(Session& session, const std::function<void()>& work);

}  // namespace npfem::app
