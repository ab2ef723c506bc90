// SPDX-License-Identifier: MPL-2.0
// npfem import: a parameter file of Palabos-npFEM, and all that it names, as a scene.
#include <cstdio>
#include <filesystem>

#include "file.h"
#include "import/import_lineage.h"
#include "quantity.h"
#include "session.h"

namespace npfem::app {
namespace {

struct ImportOptions {
  std::string parameters, scene;
  std::string coupling = "implicit";
  bool overwrite = false;
};

void require_free(const std::filesystem::path& path, bool overwrite) {
  if (!overwrite && std::filesystem::exists(path)) {
    throw text::InputError("\"" + path.string() + "\" exists already; give another name with -o, or --overwrite");
  }
}

/// Both files or none.
void write(const ImportOptions& options, const flow::LineageImport& imported) {
  const std::filesystem::path cells = flow::cells_file_of(options.scene);
  if (imported.cells.empty()) return text::write_file(options.scene, imported.scene);
  require_free(cells, options.overwrite);
  flow::write_cells_file(cells.string(), imported.cells);
  try {
    text::write_file(options.scene, imported.scene);
  } catch (const text::FileError&) {
    std::filesystem::remove(cells);
    throw;
  }
}

int import(const ImportOptions& options) {
  if (flow::cells_file_of(options.scene) == options.scene) {
    throw text::InputError("\"" + options.scene + "\": a scene must not end in .cells; take .toml");
  }
  require_free(options.scene, options.overwrite);
  const flow::LineageImport imported = flow::import_lineage(options.parameters, options.scene, options.coupling);
  write(options, imported);
  std::printf("%s written", options.scene.c_str());
  if (!imported.cells.empty()) std::printf(", with %s", flow::cells_file_of(options.scene).c_str());
  std::puts("; what differs from the run of Palabos-npFEM:");
  for (const std::string& note : imported.notes) std::printf("- %s\n", note.c_str());
  return done;
}

}  // namespace

Action add_import(CLI::App& program) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = program.add_subcommand("import", "make a scene of a parameter file of Palabos-npFEM");
  command->add_option("parameters", options->parameters, "its parameter file (.xml)")->required();
  command->add_option("-o,--output", options->scene, "scene file to write (.toml)")->required();
  command->add_option("--coupling", options->coupling, "implicit, peskin or lineage")
      ->check(CLI::IsMember({"implicit", "peskin", "lineage"}))
      ->capture_default_str();
  command->add_flag("--overwrite", options->overwrite, "replace the scene that is there");
  return [options](Session& session) { return session.first() ? import(*options) : static_cast<int>(done); };
}

}  // namespace npfem::app
