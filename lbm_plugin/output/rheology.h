// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "communicator/communicator.h"
#include "output/table_file.h"
#include "output/wall_forces.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// What the suspension does as a whole at one time, in um, us, fg; NaN where a domain knows no such number. Formulas
/// and sources: docs/output.md.
struct Rheology {
  double wall_stress = 0;            ///< Pa, along the flow
  double relative_viscosity = 0;     ///< against the plain fluid
  double mean_velocity = 0;          ///< um/us, over the fluid nodes, along the flow
  double flow_rate = 0;              ///< um3/us
  double haematocrit = 0;            ///< of the vessel: volume of the cells over that open to the fluid
  double discharge_haematocrit = 0;  ///< of what flows out
  double cell_free_layer = 0;        ///< um
  double least_gap = 0;              ///< um, and the next: the worst so far, see Counters
  double worst_volume_error = 0;
  std::vector<Vec3> displacement;  ///< um2, mean square along x, y, z of the cells of each type since their placement
};

/// rheology.csv: one line per time, from the first step on. Calls are collective; what they say is the same for any
/// number of ranks.
class RheologyTable {
 public:
  RheologyTable(Communicator& communicator, const std::filesystem::path& path, const Setup& setup,
                std::optional<std::int64_t> resumed_at);

  void append(const Simulation& simulation, std::span<const CellState> local_cells);

  /// Of the lines that a resumed run has found; -1 without any.
  std::int64_t last_step() const { return file_.last_step(); }

 private:
  Communicator& communicator_;
  TableFile file_;
};

/// Every column of a rheology.csv averaged over the second half of its time, displacements and what is the worst so
/// far as they are in the last line; empty without a line. Used by one rank.
std::vector<std::pair<std::string, double>> rheology_means(const std::filesystem::path& path);

}  // namespace npfem::flow
