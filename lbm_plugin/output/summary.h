// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "communicator/communicator.h"
#include "scene/scene.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// What summary.json says about a run.
struct Summary {
  std::string title;
  std::string version;
  std::int64_t steps = 0;
  double time_us = 0;
  double wall_s = 0;  ///< of the time loop, output included; of all jobs of a run that was resumed
  std::optional<std::int64_t> resumed_from;  ///< step from which the last job went on
  double mlups = 0;                          ///< million updates of fluid nodes per second of wall time
  double cell_steps_per_s = 0;
  int ranks = 1;
  std::int64_t fluid_nodes = 0;
  int cells = 0;  ///< in the run at its end
  std::vector<std::string> cell_types;
  std::vector<int> cells_by_type;
  double haematocrit = 0;  ///< volume of all cells over the volume open to the fluid
  std::vector<double> haematocrit_by_type;
  int cells_left = 0;  ///< through openings
  std::vector<int> cells_left_by_type;
  std::vector<double> volume_left_by_type;  ///< um3, of each as it was when it left
  double momentum_error = 0;
  double volume_error = 0;
  double minimum_gap_um = 0;
  std::int64_t crossings = 0;  ///< pairs of triangles of different surfaces that cut each other
  double worst_residual_pN = 0;
  double iterations_per_cell_step = 0;
  std::vector<std::pair<std::string, double>> rheology;  ///< on rank 0, see rheology_means()
  Counters counters;
  std::vector<CellFailure> failures;
  std::uint64_t state_hash = 0;
  bool interrupted = false;
  bool fluid_failed = false;  ///< the fluid is no longer finite
};

/// True when the fluid of some rank holds a number that is not finite. Collective.
bool fluid_failed(const Simulation& simulation, Communicator& communicator);

/// Collective.
Summary summarise(const Scene& scene, const Simulation& simulation, Communicator& communicator, double wall_s);

/// As JSON text; numbers that are not finite become null.
std::string to_json(const Summary& summary);

}  // namespace npfem::flow
