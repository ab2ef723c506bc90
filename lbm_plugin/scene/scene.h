// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "placement/cells_file.h"
#include "simulation/setup.h"
#include "toml_reader.h"

namespace npfem::flow {

/// One [[cells]] table: a type of cell and how many of it.
struct CellsRequest {
  explicit CellsRequest(const text::Table& its_table) : table(its_table) {}

  std::string name;
  std::string material;  ///< preset, or path from the working directory
  bool material_is_file = false;
  std::string mesh_file;       ///< empty: the shape of the material
  int level = -1;              ///< -1: that of the material
  std::string body_folder;     ///< of Palabos-npFEM, instead of material and mesh; empty: none
  double body_density = 0;     ///< fg/um3, of that body beyond the fluid it holds
  double volume_weight = 250;  ///< pN/um, of that body
  double interior_viscosity_ratio = 1;
  double pull = 0, pull_contact = 0;  ///< pN on either side; um
  std::optional<double> haematocrit;
  std::optional<int> count;
  std::optional<double> ratio;  ///< cells per cell of the type `ratio_to`
  int ratio_to = -1;
  std::vector<CellStart> positions;
  text::Table table;                         ///< for errors found later
  std::vector<text::Table> position_tables;  ///< as positions
};

struct OutputSettings {
  bool cells = true, fluid = true;
  // fluid steps between outputs; 0: at the start and the end only
  std::int64_t cells_every = 0, fluid_every = 0, table_every = 0;
  bool into_box = true;
  bool vtu = true, vtkhdf = false;
  std::int64_t checkpoint_every = 0;  ///< fluid steps; 0: only when the run is stopped
  int checkpoint_keep = 2;
};

/// How fast the flow without cells becomes.
struct FlowScale {
  std::optional<double> velocity = 0;    ///< largest, um/us; none: unknown
  std::optional<double> shear_rate = 0;  ///< largest, 1/us; none: unknown
  bool estimated = false;                ///< from the narrowest section, see geometry/channel_flow.h; else exact
};

/// A scene file, read and checked as far as that goes without making any cell.
struct Scene {
  explicit Scene(text::Document read) : document(std::move(read)) {}

  text::Document document;
  std::filesystem::path folder;  ///< that its paths start from
  std::string title;
  Setup setup;  ///< all but types and cells
  std::vector<CellsRequest> requests;
  std::vector<std::pair<std::string, double>> solver_options;
  std::uint64_t seed = 1;
  double gap = 0;
  std::string cells_file;           ///< empty: cells are placed as the requests say
  std::vector<StoredCells> stored;  ///< with a cells file: its cells, by request
  std::int64_t steps = 0;
  OutputSettings output;
  FlowScale flow;
  std::vector<std::string> warnings;  ///< of what the scene asks for and may not mean
};

/// Reads the file; `assignments` are like "run.steps=100". Throws text::InputError (with file, line and column) or
/// text::FileError.
Scene read_scene(const std::string& path, const std::vector<std::string>& assignments = {});

/// The same from text; `name` stands for the file in messages, and paths are taken from the working directory.
Scene parse_scene(const std::string& text, const std::string& name, const std::vector<std::string>& assignments = {});

/// The record of what a run was made from: the scene as TOML, changes and defaults included, its files by their full
/// paths.
std::string resolved_text(Scene& scene);

/// The STL files of its walls, by the keys that name them: "domain.surface", "domain.solids[0].surface".
std::vector<std::pair<std::string, std::string>> surface_files(const Scene& scene);

}  // namespace npfem::flow
