// SPDX-License-Identifier: MPL-2.0
// Inputs of the lineage (Palabos-npFEM) as scenes: its parameter file, body folders, placing file, checkpoints and
// wall surfaces, unchanged. What they mean is kept, defects of the program that reads them are not; every difference
// is said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "placement/cells_file.h"

namespace npfem::flow {

struct LineageImport {
  std::string scene;               ///< text of the scene file
  std::vector<StoredCells> cells;  ///< for a cells file beside it; empty: none is needed
  std::vector<std::string> notes;  ///< what differs from the lineage's run, and why; in the scene too
};

/// Reads the parameter file and what it names, from its folder. The scene will lie at `scene_path`, its cells file
/// beside it, of the same name but for the ending ".cells". `coupling` is a word of the key coupling.scheme.
/// text::InputError or text::FileError, with file, line and key, where something cannot be used.
LineageImport import_lineage(const std::filesystem::path& parameters, const std::filesystem::path& scene_path,
                             const std::string& coupling);

/// The cells file that belongs to a scene.
std::filesystem::path cells_file_of(const std::filesystem::path& scene_path);

}  // namespace npfem::flow
