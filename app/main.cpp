// SPDX-License-Identifier: MPL-2.0
// The npfem program.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <new>
#include <utility>
#include <vector>

#include "external_verb.h"
#include "file.h"
#include "lattice/threads.h"
#include "nearest.h"
#include "npfem/npfem.hpp"
#include "quantity.h"
#include "session.h"

namespace npfem::app {
namespace {

struct Verb {
  CLI::App* command;
  Action action;
};

std::vector<Verb> add_verbs(CLI::App& program) {
  std::vector<Verb> verbs;
  for (const auto add : {add_run, add_resume, add_pack, add_plan, add_validate, add_mesh, add_inspect, add_import,
                         add_bench, add_keys, add_version}) {
    Action action = add(program);
    verbs.push_back({program.get_subcommands({}).back(), std::move(action)});
  }
  return verbs;
}

std::string python_help() {
  std::string help = "Further verbs:\n";
  for (const PythonVerb& verb : python_verbs()) {
    help += "  " + std::string(verb.name) + std::string(28 - std::string(verb.name).size(), ' ') + verb.help + "\n";
  }
  return help + "  anything else               runs npfem-<verb>, where there is such a program";
}

bool is_own(const std::string& given, const std::vector<Verb>& verbs) {
  return std::any_of(verbs.begin(), verbs.end(), [&](const Verb& verb) { return verb.command->get_name() == given; });
}

std::string unknown_verb(const std::string& given, const std::vector<Verb>& verbs) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.command->get_name());
  for (const PythonVerb& verb : python_verbs()) names.emplace_back(verb.name);
  return "unknown verb \"" + given + "\"" + text::suggestion(given, names);
}

int carry_out(CLI::App& program, const std::vector<Verb>& verbs, Session& session, int argc, char** argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == 0;
    if (session.first()) program.exit(error);
    return asked_for_help ? done : bad_input;
  }
  for (const Verb& verb : verbs) {
    if (verb.command->parsed()) return verb.action(session);
  }
  return bad_input;
}

/// Says what went wrong, once: input errors are the same on every rank, and so are those a Communicator has agreed on.
/// Any other failure may be one rank's alone; then all are ended, for the others would wait for ever.
int guarded(Session& session, const std::function<int()>& work) {
  const auto say = [](const std::string& message) { std::cerr << "npfem: " << message << std::endl; };
  const auto fail_alone = [&](const std::string& message) {
    say(message);
    if (session.communicator.size() > 1) session.communicator.abort(failed);
    return static_cast<int>(failed);
  };
  try {
    return work();
  } catch (const text::InputError& error) {
    if (session.first()) say(error.what());
    return bad_input;
  } catch (const text::FileError& error) {
    if (session.first()) say(error.what());
    return bad_input;
  } catch (const api::Failure& failure) {
    if (!is_bad_input(failure) || session.communicator.size() > 1) return fail_alone(failure.what());
    say(failure.what());
    return bad_input;
  } catch (const std::bad_alloc&) {
    return fail_alone("out of memory");
  } catch (const std::logic_error& error) {
    return fail_alone(error.what());
  } catch (const std::runtime_error& error) {
    if (session.first()) say(error.what());
    return failed;
  }
}

}  // namespace

int run_program(int argc, char** argv) {
  CLI::App program{"Deformable blood cells in a flowing fluid."};
  program.name("npfem");
  program.require_subcommand(1);
  program.set_version_flag("--version",
                           "npfem " + api::text_of([](char* b, std::int32_t n) { return npfem_version(b, n); }));
  program.footer(python_help());
  const std::vector<Verb> verbs = add_verbs(program);

  if (argc > 1 && argv[1][0] != '-' && !is_own(argv[1], verbs)) {
    try_external_verb(argv[1], argc, argv);
    std::cerr << "npfem: " << unknown_verb(argv[1], verbs) << "\n";
    return bad_input;
  }
  // Ranks share the cores between them; threads on top of them only where the user asks for some.
  if (std::getenv("OMP_NUM_THREADS") == nullptr) flow::set_lattice_threads(1);
  const std::unique_ptr<flow::Communicator> communicator = make_communicator(&argc, &argv);
  Session session{*communicator};
  return guarded(session, [&] { return carry_out(program, verbs, session, argc, argv); });
}

}  // namespace npfem::app

int main(int argc, char** argv) {
  return npfem::app::run_program(argc, argv);
}
