// SPDX-License-Identifier: MPL-2.0
// npfem validate: everything that can be found wrong with a scene before it is run.
#include <algorithm>
#include <cstdio>
#include <iostream>

#include <nlohmann/json.hpp>

#include "assessment.h"
#include "file.h"
#include "quantity.h"
#include "scene/make_cells.h"
#include "scene/scene.h"
#include "scene_options.h"
#include "session.h"

namespace npfem::app {
namespace {

struct ValidateOptions {
  SceneOptions scene;
  bool json = false;
};

int validate(const ValidateOptions& options) {
  flow::Scene scene = flow::read_scene(options.scene.path, options.scene.assignments);
  flow::make_types(scene);
  const flow::PlacementReport placement = flow::place_scene_cells(scene);
  const std::vector<flow::Limit> limits = limits_of(scene);
  const std::vector<std::string> warnings = warnings_of(scene);
  if (options.json) {
    const nlohmann::ordered_json json{{"valid", true},
                                      {"cells", scene.setup.cells.size()},
                                      {"grown", placement.grown},
                                      {"warnings", warnings},
                                      {"limits", limits_as_json(limits)}};
    std::cout << json.dump(2) << "\n";
    return done;
  }
  std::printf("%s: valid; %zu cells placed%s\n", options.scene.path.c_str(), scene.setup.cells.size(),
              placement.grown ? " by growth from small" : "");
  for (const std::string& warning : warnings) std::printf("warning: %s\n", warning.c_str());
  print_limits(limits);
  const auto exceeded = std::count_if(limits.begin(), limits.end(),
                                      [](const flow::Limit& l) { return l.verdict == flow::Verdict::exceeded; });
  if (exceeded > 0) std::printf("warning: %td of these bounds exceeded; see above\n", exceeded);
  return done;
}

/// With --json the error is data too.
int validate_or_say_why_not(const ValidateOptions& options) {
  const auto refuse = [](const std::string& message) {
    const nlohmann::ordered_json json{{"valid", false}, {"error", message}};
    std::cout << json.dump(2) << "\n";
    return bad_input;
  };
  if (!options.json) return validate(options);
  try {
    return validate(options);
  } catch (const text::InputError& error) {
    return refuse(error.what());
  } catch (const text::FileError& error) {
    return refuse(error.what());
  }
}

}  // namespace

Action add_validate(CLI::App& program) {
  const auto options = std::make_shared<ValidateOptions>();
  CLI::App* command = program.add_subcommand("validate", "check a scene without running it");
  options->scene.add_to(*command);
  command->add_flag("--json", options->json, "print the result as JSON");
  return [options](Session& session) {
    return session.first() ? validate_or_say_why_not(*options) : static_cast<int>(done);
  };
}

}  // namespace npfem::app
