// SPDX-License-Identifier: MPL-2.0
#include "output/run_output.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <system_error>

#include "checkpoint/checkpoint_folder.h"
#include "file.h"
#include "output/view_script.h"
#include "output/vtkhdf.h"
#include "output/write_cells.h"
#include "output/write_fluid.h"

namespace npfem::flow {
namespace {

/// "cells_000000120.vtu"
std::string numbered(const char* name, std::int64_t step, const char* ending) {
  char text[64];
  std::snprintf(text, sizeof text, "%s_%09lld.%s", name, static_cast<long long>(step), ending);
  return text;
}

bool written_by_a_run(std::string file) {
  if (file.ends_with(".part")) file.resize(file.size() - 5);  // of a run that was killed
  for (const char* whole : {"cells.pvd", "fluid.pvd", "cells.vtkhdf", "fluid.vtkhdf", "cells.csv", "rheology.csv",
                            "left.csv", "summary.json", "scene.toml", "view.py"}) {
    if (file == whole) return true;
  }
  const auto framed = [&](const std::string& begin, const std::string& end) {
    return file.size() > begin.size() + end.size() && file.starts_with(begin) && file.ends_with(end) &&
           file.find_first_not_of("0123456789", begin.size()) == file.size() - end.size();
  };
  return framed("cells_", ".vtu") || framed("fluid_", ".vti");
}

/// Whether the folder bears the mark of a run. A scene.toml or a cells.csv alone may be anybody's.
bool holds_a_run(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (written_by_a_run(file) && file != "scene.toml" && file != "cells.csv" && file != "view.py") return true;
  }
  return false;
}

void remove_files(const std::filesystem::path& folder, bool (*unwanted)(std::string file)) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path file = entry.path();
    if (!unwanted(file.filename().string())) continue;
    if (!std::filesystem::remove(file, error)) {
      throw text::FileError("cannot remove \"" + file.string() + "\": " + error.message());
    }
  }
}

bool holds_nothing(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().filename() != lock_file_name) return false;
  }
  return true;
}

void remove_earlier_run(const std::filesystem::path& folder) {
  std::error_code error;
  if (!holds_a_run(folder)) {
    throw text::FileError("output folder \"" + folder.string() +
                          "\" holds files but no run that could be replaced; choose another folder");
  }
  remove_files(folder, written_by_a_run);
  const std::filesystem::path checkpoints = CheckpointFolder(folder).path();
  remove_files(checkpoints, CheckpointFolder::is_ours);
  std::filesystem::remove(checkpoints, error);  // unless something else is in it
}

}  // namespace

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error)) {
    if (std::filesystem::is_directory(folder)) return;
    throw text::FileError("cannot write to \"" + folder.string() + "\": it is not a folder");
  }
  std::filesystem::create_directories(folder, error);
  if (error) throw text::FileError("cannot create the folder \"" + folder.string() + "\": " + error.message());
}

void prepare_output_folder(const std::filesystem::path& folder, bool overwrite) {
  make_output_folder(folder);
  if (holds_nothing(folder)) return;
  if (!overwrite) {
    throw text::FileError("the output folder \"" + folder.string() +
                          "\" is not empty; choose another one, or add --overwrite to replace the run in it");
  }
  remove_earlier_run(folder);
}

namespace {

/// The step up to which the output of a resumed run stays: of the state it stopped in only what is due there, as if it
/// had never stopped. Every run shows its first state and its last one.
std::optional<std::int64_t> kept_up_to(std::optional<std::int64_t> resumed_at, std::int64_t every, const Scene& scene) {
  if (!resumed_at) return {};
  const std::int64_t step = *resumed_at;
  const bool due = step == 0 || step == scene.steps || (every > 0 && step % every == 0);
  return due ? step : step - 1;
}

}  // namespace

RunOutput::RunOutput(Communicator& communicator, std::filesystem::path folder, const Scene& scene,
                     std::optional<std::int64_t> resumed_at)
    : communicator_(communicator),
      folder_(std::move(folder)),
      settings_(scene.output),
      cells_{scene.output.cells && !scene.setup.cells.empty(), scene.output.cells_every},
      fluid_{scene.output.fluid, scene.output.fluid_every},
      table_{true, scene.output.table_every},
      cells_collection_(folder_ / "cells.pvd"),
      fluid_collection_(folder_ / "fluid.pvd"),
      cell_table_(communicator, folder_ / "cells.csv", scene.setup, kept_up_to(resumed_at, table_.every, scene)),
      rheology_table_(communicator, folder_ / "rheology.csv", scene.setup,
                      kept_up_to(resumed_at, table_.every, scene)) {
  if (!scene.setup.cells.empty() && !scene.setup.domain.openings.empty()) {
    departure_table_.emplace(communicator, folder_ / "left.csv");
  }
  on_first_rank([&] { text::write_file((folder_ / "view.py").string(), view_script()); });
  if (resumed_at) resume(*resumed_at, scene);
}

/// A checkpoint is written after all output of its step: what there is of that step is whole.
void RunOutput::resume(std::int64_t step, const Scene& scene) {
  const auto take_up = [&](Schedule& schedule, Collection& collection, const char* vtkhdf) {
    const std::int64_t last = *kept_up_to(step, schedule.every, scene);
    bool present = false;
    on_first_rank([&] {
      if (!schedule.wanted) return;
      present = collection.resume(last);
      present = cut_vtkhdf(folder_ / vtkhdf, static_cast<double>(last) * scene.setup.time_step) || present;
    });
    if (communicator_.any(present) && last == step) schedule.last = step;
  };
  take_up(cells_, cells_collection_, "cells.vtkhdf");
  take_up(fluid_, fluid_collection_, "fluid.vtkhdf");
  if (std::max(cell_table_.last_step(), rheology_table_.last_step()) == step) table_.last = step;
}

void RunOutput::write_due(const Simulation& simulation) {
  const std::int64_t step = simulation.steps_done();
  write(simulation, cells_.due(step), fluid_.due(step), table_.due(step));
}

void RunOutput::write_all(const Simulation& simulation) {
  const std::int64_t step = simulation.steps_done();
  const auto missing = [step](const Schedule& schedule) { return schedule.wanted && schedule.last != step; };
  write(simulation, missing(cells_), missing(fluid_), missing(table_));
}

void RunOutput::write(const Simulation& simulation, bool cells, bool fluid, bool table) {
  const std::int64_t step = simulation.steps_done();
  if (departure_table_) departure_table_->append(simulation);
  if (cells || table) {
    const std::vector<CellState> local = simulation.local_cells();
    if (cells) write_cell_files(simulation, local);
    if (table) {
      cell_table_.append(step, simulation.time_us(), local);
      // there are no wall forces before the first step
      if (step > 0) rheology_table_.append(simulation, local);
      table_.last = step;
    }
  }
  if (fluid) write_fluid_files(simulation);
}

void RunOutput::write_cell_files(const Simulation& simulation, std::span<const CellState> local) {
  const double time = simulation.time_us();
  const CellArrays arrays = cell_arrays(simulation.setup(), simulation.departures(), local, settings_.into_box);
  if (settings_.vtu) {
    const std::string file = numbered("cells", simulation.steps_done(), "vtu");
    write_cells(communicator_, folder_ / file, time, arrays);
    on_first_rank([&] { cells_collection_.add(time, file); });
  }
  if (settings_.vtkhdf) append_cells(communicator_, folder_ / "cells.vtkhdf", time, arrays);
  cells_.last = simulation.steps_done();
}

void RunOutput::write_fluid_files(const Simulation& simulation) {
  const double time = simulation.time_us();
  const FluidArrays arrays = fluid_arrays(simulation.lattice(), simulation.units());
  if (settings_.vtu) {
    const std::string file = numbered("fluid", simulation.steps_done(), "vti");
    write_fluid(communicator_, folder_ / file, time, arrays);
    on_first_rank([&] { fluid_collection_.add(time, file); });
  }
  if (settings_.vtkhdf) append_fluid(communicator_, folder_ / "fluid.vtkhdf", time, arrays);
  fluid_.last = simulation.steps_done();
}

void RunOutput::on_first_rank(const std::function<void()>& write) {
  std::string failure;
  if (communicator_.rank() == 0) {
    try {
      write();
    } catch (const text::FileError& error) {
      failure = error.what();
    }
  }
  communicator_.agree(failure);
}

}  // namespace npfem::flow
