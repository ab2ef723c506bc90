// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "lattice/lattice.h"
#include "simulation/departures.h"
#include "simulation/setup.h"
#include "units.h"

namespace npfem::flow {

class CheckpointFile;
class CheckpointWriter;
struct CheckpointHeader;

/// A cell whose step failed. It stays where it was, with the state it had before that step.
struct CellFailure {
  int id;             ///< global id of the cell
  int type;           ///< index into Setup::types
  std::int64_t step;  ///< fluid step in which it failed
  std::string reason;
};

/// One cell as output sees it, at the present time. Copies: valid for as long as the reader keeps them.
struct CellState {
  int id;                        ///< global id
  int type;                      ///< index into Setup::types
  std::vector<double> position;  ///< xyz of every vertex, um, unwrapped: whole also across a periodic face
  std::vector<double> velocity;  ///< um/us
  std::vector<double> force;     ///< pN, exerted on the fluid
  double volume;                 ///< um3
  double area;                   ///< um2
  int status;                    ///< NPFEM_CELL_... of its last step
  int iterations;                ///< of its last step
  double residual;               ///< pN, of its last step
};

/// What a run has done so far, by the whole system; times are this rank's.
struct Counters {
  std::int64_t cell_steps = 0;   ///< steps of single cells
  std::int64_t iterations = 0;   ///< iterations of the cell solver over all cells and steps
  double worst_residual_pN = 0;  ///< largest residual force that any cell step ended with
  double fluid_seconds = 0;      ///< in the lattice
  double cell_seconds = 0;       ///< in the cell solver and in moving cells between ranks
  double exchange_seconds = 0;   ///< between vertices and nodes: interpolation, spreading, contacts, messages
  /// Least distance (um) of a vertex to another cell in any solve, negative inside it; infinite while none has come
  /// within the range of contacts.
  double least_gap_um = std::numeric_limits<double>::infinity();
  double worst_volume_error = 0;  ///< of any cell, looked at in every tenth solve
};

/// A suspension of deformable cells in a lattice Boltzmann fluid: the whole coupled run, one fluid step at a time.
///
/// The same setup gives the same bits for any number of ranks. Calls marked collective must be made by all ranks.
class Simulation {
 public:
  /// Places the cells and starts the fluid: at rest, or with the steady flow that would be there without cells. Lattice
  /// and cells hold the forces of the first positions, so that cells that start under tension start without a jump.
  /// Collective. Throws std::exception, saying what is wrong, where the setup cannot run.
  Simulation(const Setup& setup, Communicator& communicator);

  /// Goes on from the state in a verified checkpoint of a run with this setup, with the same bits as if it had never
  /// stopped. Collective. Throws std::exception where the checkpoint does not fit the setup.
  Simulation(const Setup& setup, Communicator& communicator, CheckpointFile& file, const CheckpointHeader& header);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  /// Advances fluid and cells by one fluid step; the cells are solved at every steps_per_solve-th. Collective.
  void step();

  /// Writes the whole state into the sections of a checkpoint and fills in what its header says about the run so far.
  /// Collective; std::runtime_error on every rank where it cannot be written.
  void save(CheckpointWriter& file, CheckpointHeader& header) const;

  /// Every cell that has failed so far, in order of step and id; the same list on every rank.
  const std::vector<CellFailure>& failures() const;

  /// Every cell that has left through an opening so far, in order of step and id; the same list on every rank.
  const std::vector<Departure>& departures() const;

  std::int64_t steps_done() const;
  double time_us() const;
  const Setup& setup() const;
  const Units& units() const;
  const Lattice& lattice() const;
  const Decomposition& decomposition() const;

  /// The cells this rank owns, in order of global id.
  std::vector<CellState> local_cells() const;
  /// Cells of the whole system: those of the setup but for those that have left.
  int cell_count() const;

  Counters counters() const;  ///< collective
  /// Seconds of this rank by phase of the time step, in the order in which the phases follow each other.
  std::vector<std::pair<std::string, double>> phase_seconds() const;
  double volume_error() const;       ///< max over all cells of |V / V_start - 1|; collective
  double momentum_error() const;     ///< see coupling/momentum_audit.h; collective
  double minimum_gap() const;        ///< um, see contact/minimum_gap.h: signed; collective
  std::int64_t crossings() const;    ///< pairs of triangles of different surfaces that cut each other; collective
  double minimum_wall_gap() const;   ///< um, vertex to wall, infinity without walls; collective
  std::uint64_t state_hash() const;  ///< of fluid and cells, the same for any number of ranks; collective

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace npfem::flow
