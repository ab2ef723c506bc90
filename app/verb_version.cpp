// SPDX-License-Identifier: MPL-2.0
// npfem version: what this build is.
#include <iostream>

#include "session.h"

namespace npfem::app {

Action add_version(CLI::App& program) {
  program.add_subcommand("version", "print the version and how this program was built");
  return [](Session& session) {
    if (!session.first()) return done;
    std::cout << "npfem " << api::text_of([](char* b, std::int32_t n) { return npfem_version(b, n); }) << "\n"
              << api::text_of([](char* b, std::int32_t n) { return npfem_build_info(b, n); }) << "\n";
    return done;
  };
}

}  // namespace npfem::app
