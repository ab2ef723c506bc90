// SPDX-License-Identifier: MPL-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "output/vtkhdf.h"
#include "quantity.h"
#include "scene/quality.h"
#include "scene/read_parts.h"
#include "scene/scene.h"
#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

using text::format_quantity;
using text::Key;
using text::Table;

void expect(const Table& table, const std::string& path) {
  for (const SceneSection& section : scene_sections()) {
    if (section.path != path) continue;
    for (const Key& key : section.keys) table.has(key);
  }
}

/// Refuses unknown keys before anything is read: a misspelt key is then named, not reported missing.
void require_known_keys(const Table& root) {
  expect(root, "");
  for (const char* section :
       {"domain", "fluid", "flow", "placement", "coupling", "lineage", "contact", "solver", "run", "output"}) {
    if (root.has(section)) expect(root.table(section), section);
  }
  for (const Table& solid : root.table("domain").tables("solids")) expect(solid, "domain.solids");
  for (const Table& opening : root.tables("openings")) expect(opening, "openings");
  if (root.table("flow").has("waveform")) expect(root.table("flow").table("waveform"), "flow.waveform");
  for (const Table& cells : root.tables("cells")) {
    expect(cells, "cells");
    for (const Table& position : cells.tables("positions")) expect(position, "cells.positions");
  }
  if (root.has("contact")) {
    for (const Table& pair : root.table("contact").tables("pairs")) expect(pair, "contact.pairs");
  }
  root.finish();
}

void read_coupling(const Table& table, Setup& setup) {
  const std::string scheme = table.choice(keys::scheme);
  setup.coupling.scheme = scheme == "implicit" ? CouplingScheme::implicit
                          : scheme == "peskin" ? CouplingScheme::peskin
                                               : CouplingScheme::lineage;
  setup.coupling.kernel_points = within(table, keys::kernel, 2, 4);
  if (table.has(keys::inset)) {
    setup.coupling.inset = table.quantity(keys::inset);
    if (*setup.coupling.inset > 1) table.fail("inset", "may be up to 1 node");
    if (setup.coupling.scheme == CouplingScheme::lineage) {
      table.fail("inset", "is not for scheme \"lineage\"; leave it out");
    }
  }
  setup.coupling.steps_per_solve = within(table, keys::cell_every, 1, 1000);
  setup.coupling.forcing_iterations = within(table, keys::forcing_iterations, 1, 100);
  if (setup.coupling.forcing_iterations != 1 && setup.coupling.scheme != CouplingScheme::lineage) {
    table.fail("forcing_iterations", "is for scheme \"lineage\" only; leave it out");
  }
}

std::vector<std::pair<std::string, double>> read_solver(const Table& table) {
  std::vector<std::pair<std::string, double>> options;
  if (table.has(keys::tolerance)) options.emplace_back("tolerance", table.quantity(keys::tolerance));
  if (table.has(keys::residual_bound)) options.emplace_back("residual_bound", table.quantity(keys::residual_bound));
  if (table.has(keys::max_iterations)) {
    options.emplace_back("max_iterations", within(table, keys::max_iterations, 1, 1000000));
  }
  if (table.has(keys::newton_iterations)) {
    options.emplace_back("newton_iterations", within(table, keys::newton_iterations, 0, 1000000));
  }
  const std::string precision = table.choice(keys::precision);
  options.emplace_back("precision", precision == "double" ? 0 : precision == "mixed" ? 1 : 2);
  return options;
}

std::int64_t whole_steps(const Table& table, const Key& key, double time_step) {
  const double steps = table.quantity(key) / time_step;
  if (steps > 1e15) table.fail(key.name, "is more than 1e15 time steps of " + format_quantity(time_step, "us"));
  return steps > 0 ? std::max<std::int64_t>(1, std::llround(steps)) : 0;
}

/// The driving is set anew when the cells are solved and holds between: a period is then sampled at so many points.
void require_slow_waveform(const Table& flow, const Setup& setup) {
  constexpr double least_points = 20;
  if (setup.waveform.is_constant()) return;
  const double between = setup.coupling.steps_per_solve * setup.time_step;
  const double period = setup.waveform.period();
  if (period >= least_points * between) return;
  flow.table("waveform")
      .fail(keys::period.name, format_quantity(period, "us") + " is less than 20 times the " +
                                   format_quantity(rounded(between), "us") +
                                   " for which the driving is held (time_step x cell_every): the flow would not follow "
                                   "the wave; take a longer period, a smaller time step or a smaller cell_every");
}

/// Steps may shorten the time, as in --set run.steps=10; more of them than it lasts would be ignored.
std::int64_t read_steps(const Table& table, double time_step) {
  const bool by_steps = table.has(keys::steps);
  const bool by_time = table.has(keys::time);
  if (!by_steps && !by_time) table.fail("\"steps\" or \"time\" is needed");
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();
  if (by_steps) steps = table.integer(keys::steps);
  if (!by_time) return steps;
  const std::int64_t whole = whole_steps(table, keys::time, time_step);
  if (by_steps && steps > whole) {
    table.fail(keys::steps.name, std::to_string(steps) + " are more than the " + std::to_string(whole) +
                                     " of \"run.time\", " + format_quantity(table.quantity(keys::time), "us") +
                                     ", which ends the run first; give a longer time, or no steps");
  }
  return std::min(steps, whole);
}

OutputSettings read_output(const Table& table, double time_step) {
  OutputSettings output;
  output.cells = table.boolean(keys::cells);
  output.fluid = table.boolean(keys::fluid);
  output.cells_every = whole_steps(table, keys::cells_every, time_step);
  output.fluid_every = whole_steps(table, keys::fluid_every, time_step);
  output.table_every = whole_steps(table, keys::table_every, time_step);
  output.into_box = table.boolean(keys::into_box);
  const std::string format = table.choice(keys::format);
  output.vtu = format != "vtkhdf";
  output.vtkhdf = format != "vtu";
  if (output.vtkhdf && !has_vtkhdf()) {
    table.fail(keys::format.name, "this build has no HDF5, which \"" + format + "\" needs; allowed: \"vtu\"");
  }
  output.checkpoint_every = table.integer(keys::checkpoint_every);
  output.checkpoint_keep = within(table, keys::checkpoint_keep, 1, 1000000);
  return output;
}

Scene read(text::Document document, const std::filesystem::path& folder, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) document.set(assignment);
  apply_quality(document);
  Scene scene(std::move(document));
  scene.folder = folder;
  const Table root = scene.document.root();
  require_known_keys(root);
  if (root.integer(keys::schema_version) != 1) root.fail("schema_version", "this program reads version 1 only");
  scene.title = root.text(keys::title);
  Setup& setup = scene.setup;
  setup.domain = read_domain(root.table("domain"));
  read_openings(root, setup.domain);
  read_walls(root.table("domain"), setup.domain, folder);
  read_fluid(root.table("fluid"), setup);
  read_flow(root, scene);
  const Table placement = root.table("placement");
  read_placement(placement, scene, folder);
  for (const Table& cells : root.tables("cells")) scene.requests.push_back(read_cells(cells, scene, folder));
  read_random_placement(placement, scene);
  match_stored_cells(placement, scene);
  read_coupling(root.table("coupling"), setup);
  require_slow_waveform(root.table("flow"), setup);
  scene.solver_options = read_solver(root.table("solver"));
  setup.coupling.lineage_steps = setup.coupling.scheme == CouplingScheme::lineage;
  if (setup.coupling.lineage_steps) {
    for (const auto& option : read_lineage(root.table("lineage"))) scene.solver_options.push_back(option);
  } else if (root.has("lineage")) {
    root.fail("lineage", "holds only with coupling.scheme = \"lineage\"");
  }
  read_contact(root.table("contact"), scene);
  scene.steps = read_steps(root.table("run"), setup.time_step);
  scene.output = read_output(root.table("output"), setup.time_step);
  return scene;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> surface_files(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> files;
  const auto look_in = [&](const Table& table, const std::string& path) {
    if (!table.has(keys::surface)) return;
    files.emplace_back(path + ".surface", path_from(table.text(keys::surface), scene.folder));
  };
  const Table domain = scene.document.root().table("domain");
  look_in(domain, "domain");
  const std::vector<Table> solids = domain.tables("solids");
  for (std::size_t n = 0; n < solids.size(); ++n) look_in(solids[n], "domain.solids[" + std::to_string(n) + "]");
  return files;
}

std::string resolved_text(Scene& scene) {
  const auto quoted = [](const std::string& file) {
    return std::string("'").append(std::filesystem::absolute(file).lexically_normal().string()).append("'");
  };
  for (std::size_t i = 0; i < scene.requests.size(); ++i) {
    const CellsRequest& request = scene.requests[i];
    const std::string path = "cells[" + std::to_string(i) + "].";
    if (request.material_is_file) scene.document.set(path + "material", quoted(request.material));
    if (!request.mesh_file.empty()) scene.document.set(path + "mesh", quoted(request.mesh_file));
    if (!request.body_folder.empty()) scene.document.set(path + "body_folder", quoted(request.body_folder));
  }
  if (!scene.cells_file.empty()) scene.document.set("placement.file", quoted(scene.cells_file));
  for (const auto& [key, file] : surface_files(scene)) scene.document.set(key, quoted(file));
  return scene.document.to_toml();
}

Scene read_scene(const std::string& path, const std::vector<std::string>& assignments) {
  return read(text::Document::parse_file(path), std::filesystem::path(path).parent_path(), assignments);
}

Scene parse_scene(const std::string& text, const std::string& name, const std::vector<std::string>& assignments) {
  return read(text::Document::parse_text(text, name), {}, assignments);
}

}  // namespace npfem::flow
