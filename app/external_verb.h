// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>
#include <vector>

namespace npfem::app {

/// Verbs that live in the Python package, with a line of help each.
struct PythonVerb {
  const char* name;
  const char* help;
};
const std::vector<PythonVerb>& python_verbs();

/// Where `verb` is not one of the program's own, hands over to it, as git finds git-<verb>: a program npfem-<verb>
/// beside this one, in ../libexec/npfem or on the PATH, or a verb of the Python package. Returns only where there is
/// none.
void try_external_verb(const std::string& verb, int argc, char** argv);

}  // namespace npfem::app
