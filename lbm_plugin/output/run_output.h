// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "communicator/communicator.h"
#include "output/cell_table.h"
#include "output/collection.h"
#include "output/departure_table.h"
#include "output/rheology.h"
#include "scene/scene.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// Of the file in an output folder by which a run at work keeps others out. It counts as no file below.
inline constexpr const char* lock_file_name = "run.lock";

/// Makes the folder where it is missing; used by one rank. text::FileError where it cannot.
void make_output_folder(const std::filesystem::path& folder);

/// Makes the folder ready for a run; used by one rank. A folder that holds anything is refused, unless `overwrite`:
/// then the files that an earlier run wrote are removed, and nothing else. text::FileError where it cannot be used.
void prepare_output_folder(const std::filesystem::path& folder, bool overwrite);

/// The files of a run: cells_*.vtu with cells.pvd, fluid_*.vti with fluid.pvd (or
/// cells.vtkhdf and fluid.vtkhdf), cells.csv, rheology.csv, left.csv where cells can leave, view.py. Calls
/// are collective and throw std::runtime_error on every rank where a file cannot be written.
class RunOutput {
 public:
  /// With `resumed_at` the files of a run that has come to that step are continued; what it wrote later is dropped
  /// from tables and collections, and so is its output of that very step where only the stop was its reason: after the
  /// end there is what a run that never stopped has written.
  RunOutput(Communicator& communicator, std::filesystem::path folder, const Scene& scene,
            std::optional<std::int64_t> resumed_at = {});

  /// Writes what is due after this step.
  void write_due(const Simulation& simulation);
  /// Writes everything that has not been written at this step: for the first and the last state.
  void write_all(const Simulation& simulation);

 private:
  /// One kind of output and when it was last written.
  struct Schedule {
    bool wanted;
    std::int64_t every;
    std::int64_t last = -1;
    bool due(std::int64_t step) const { return wanted && every > 0 && step % every == 0 && step != last; }
  };
  void resume(std::int64_t step, const Scene& scene);
  void write(const Simulation& simulation, bool cells, bool fluid, bool table);
  void write_cell_files(const Simulation& simulation, std::span<const CellState> local_cells);
  void write_fluid_files(const Simulation& simulation);
  void on_first_rank(const std::function<void()>& write);

  Communicator& communicator_;
  std::filesystem::path folder_;
  OutputSettings settings_;
  Schedule cells_, fluid_, table_;
  Collection cells_collection_, fluid_collection_;
  CellTable cell_table_;
  RheologyTable rheology_table_;
  std::optional<DepartureTable> departure_table_;  // none where no cell can leave
};

}  // namespace npfem::flow
