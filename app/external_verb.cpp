// SPDX-License-Identifier: MPL-2.0
#include "external_verb.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "session.h"

namespace npfem::app {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_program() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

fs::path find_program(const std::string& name) {
  std::vector<fs::path> folders{folder_of_program(), folder_of_program() / "../libexec/npfem"};
  const char* path = std::getenv("PATH");
  std::istringstream stream(path ? path : "");
  for (std::string folder; std::getline(stream, folder, ':');) folders.emplace_back(folder);
  for (const fs::path& folder : folders) {
    const fs::path candidate = folder / name;
    if (access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate)) return candidate;
  }
  return {};
}

[[noreturn]] void become(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  std::cerr << "npfem: cannot run \"" << command[0] << "\": " << std::strerror(errno) << "\n";
  std::exit(failed);
}

/// Where the Python package is, in an installation or beside the source; the library it is to load; this program and
/// its commit.
void show_python_the_way() {
  std::error_code error;
  setenv("NPFEM_COMMIT", NPFEM_COMMIT, 0);
  setenv("NPFEM_PROGRAM", fs::read_symlink("/proc/self/exe", error).c_str(), 0);
  const fs::path installed = folder_of_program() / ".." / NPFEM_LIBRARY_FOLDER / "npfem-python";
  std::string path = fs::exists(installed) ? installed.string() : NPFEM_PYTHON_SOURCE;
  if (const char* present = std::getenv("PYTHONPATH"); present && *present) path.append(":").append(present);
  setenv("PYTHONPATH", path.c_str(), 1);
  for (const char* folder : {"../lib", "../" NPFEM_LIBRARY_FOLDER}) {
    const fs::path library = folder_of_program() / folder / "libnpfem.so";
    if (fs::exists(library)) setenv("NPFEM_LIBRARY", library.lexically_normal().c_str(), 0);
  }
}

}  // namespace

const std::vector<PythonVerb>& python_verbs() {
  static const std::vector<PythonVerb> verbs{
      {"stretch", "stretch one cell with optical tweezers and plot the curve (Python)"},
      {"relax", "let a stretched cell go and time its recovery (Python)"},
      {"fit", "fit a material to measured cells, with intervals of confidence (Python)"},
      {"preview", "draw a picture of a run (Python)"},
      {"report", "run the validation cases and write their page (Python)"},
  };
  return verbs;
}

void try_external_verb(const std::string& verb, int argc, char** argv) {
  std::vector<std::string> rest(argv + 2, argv + argc);
  if (verb.find('/') == std::string::npos) {
    if (const fs::path program = find_program("npfem-" + verb); !program.empty()) {
      rest.insert(rest.begin(), program.string());
      become(rest);
    }
  }
  const auto& known = python_verbs();
  if (std::none_of(known.begin(), known.end(), [&](const PythonVerb& p) { return verb == p.name; })) return;
  show_python_the_way();
  const char* python = std::getenv("NPFEM_PYTHON");
  rest.insert(rest.begin(), {python && *python ? python : "/usr/bin/python3", "-m", "npfem", verb});
  become(rest);
}

}  // namespace npfem::app
