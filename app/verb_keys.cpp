// SPDX-License-Identifier: MPL-2.0
// npfem keys: the reference page of scene files, from the reader's own table.
#include <iostream>

#include "scene/scene_keys.h"
#include "session.h"

namespace npfem::app {

Action add_keys(CLI::App& program) {
  program.add_subcommand("keys", "print every key of a scene file, as Markdown");
  return [](Session& session) {
    if (session.first()) std::cout << flow::scene_reference();
    return done;
  };
}

}  // namespace npfem::app
