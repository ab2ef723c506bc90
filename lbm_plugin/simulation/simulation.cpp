// SPDX-License-Identifier: MPL-2.0
#include "simulation/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>

#include "checkpoint/cell_section.h"
#include "checkpoint/checkpoint_header.h"
#include "checkpoint/fluid_section.h"
#include "contact/minimum_gap.h"
#include "contact/surface_crossing.h"
#include "coupling/cell_population.h"
#include "coupling/coupling.h"
#include "coupling/fluid_link.h"
#include "coupling/interior.h"
#include "coupling/lineage_coupling.h"
#include "coupling/stopwatch.h"
#include "geometry/cell_shape.h"
#include "geometry/vec3.h"
#include "simulation/agreed_backend.h"
#include "simulation/balance.h"
#include "simulation/start.h"

namespace npfem::flow {
namespace {

Setup checked(Setup setup, Communicator& communicator) {
  require_sound(setup);
  setup.backend = agreed_backend(communicator, setup.backend);
  return setup;
}

/// One rank has it all and need not know where the work is.
Decomposition decomposed(const Setup& setup, std::span<const CellStart> cells, Communicator& communicator) {
  const int ranks = communicator.size();
  const PlaneWeights weights = ranks > 1 ? plane_weights(setup, cells, communicator) : PlaneWeights{};
  return {setup.domain.nodes, setup.domain.periodic(), ranks, weights};
}

CellPopulation make_cells(const Setup& setup, Communicator& communicator, const Decomposition& decomposition,
                          bool placed) {
  const double delta = setup.coupling.steps_per_solve * setup.time_step;
  return placed ? CellPopulation(setup, communicator, decomposition, delta)
                : CellPopulation::without_cells(setup, communicator, decomposition, delta);
}

Units units_of(const Setup& setup) {
  return {setup.domain.dx, setup.time_step, setup.density};
}

}  // namespace

struct Simulation::State {
  /// `present`: the cells where they are by now. With `place_cells` they are put where the setup has them.
  State(const Setup& given, Communicator& group, std::span<const CellStart> present, bool place_cells)
      : setup(checked(given, group)),
        communicator(group),
        units(units_of(setup)),
        decomposition(decomposed(setup, present, group)),
        lattice(group, decomposition, lattice_geometry(setup.domain, units), lattice_options(setup, units)),
        cells(make_cells(setup, group, decomposition, place_cells)) {
    if (!setup.cells.empty()) link.emplace(setup, units, group, lattice, audit);
    if (has_viscosity_contrast(setup)) interior.emplace(setup, group, lattice);
  }

  void start();
  void drive();
  void set_driving(std::int64_t step);
  void restore(CheckpointFile& file, const CheckpointHeader& header);
  void make_coupling();
  void load_fluid();
  void let_cells_leave();
  void mark_interior();
  void record(const CellStepReport& report);
  double own_volume_error() const;
  void record_failures(const std::vector<LocalFailure>& local);
  bool solves_now() const { return coupling && steps % setup.coupling.steps_per_solve == 0; }
  std::vector<CellSurface> surfaces() const;

  Setup setup;
  Communicator& communicator;
  Units units;
  Decomposition decomposition;
  Lattice lattice;
  CellPopulation cells;
  std::optional<Interior> interior;  // none where no cell has a viscosity of its own
  MomentumAudit audit;
  std::optional<FluidLink> link;  // this and the next: none where there are no cells
  std::unique_ptr<Coupling> coupling;
  std::vector<double> start_volumes;  // um3, by type
  std::vector<CellFailure> failures;
  std::set<int> failed_cells;
  Departures departures;
  Counters counters;  // of this rank
  Counters earlier;   // of the whole system, before this process went on
  double coupling_seconds = 0;
  std::int64_t steps = 0;
};

Simulation::Simulation(const Setup& setup, Communicator& communicator)
    : state_(std::make_unique<State>(setup, communicator, setup.cells, true)) {
  state_->start();
}
Simulation::Simulation(const Setup& setup, Communicator& communicator, CheckpointFile& file,
                       const CheckpointHeader& header)
    : state_(std::make_unique<State>(setup, communicator, load_present(setup.cells, header.departures, file), false)) {
  state_->restore(file, header);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::State::start() {
  if (const std::string misplaced = starts_in_an_opening(setup); !misplaced.empty()) {
    throw std::invalid_argument(misplaced);
  }
  if (setup.start_developed) {
    lattice.initialise([this](int ix, int iy, int iz) {
      const Vec3 position = scale(units.dx, {ix + 0.5, iy + 0.5, iz + 0.5});
      return FluidState{0, scale(1.0 / units.velocity(), developed_velocity(setup, position))};
    });
  }
  if (!setup.waveform.is_constant()) drive();
  audit.hold(lattice, {}, 0);
  make_coupling();
  if (coupling) {
    const Stopwatch watch(coupling_seconds);
    coupling->hold_present_forces();
    mark_interior();
  }
  audit.start(lattice);
}

void Simulation::State::make_coupling() {
  if (link && setup.coupling.scheme == CouplingScheme::lineage) {
    coupling =
        std::make_unique<LineageCoupling>(setup, cells, *link, OuterTraction(setup, units, communicator, lattice));
  } else if (link) {
    coupling = Coupling::create(setup, cells, *link);
  }
  for (const CellType& type : setup.types) start_volumes.push_back(enclosed_volume(type.shape, type.triangles));
}

/// Gives the fluid the driving force of the present moment; where there are cells, with their next forces, for as long
/// as it holds those.
void Simulation::State::drive() {
  set_driving(steps);
  if (coupling) return;
  lattice.clear_force();
  audit.hold(lattice, {}, 0);
}

/// Body force, plates and openings at the time of a step. Where some openings have a velocity, that is what pulsates,
/// and the pressure of the others stays.
void Simulation::State::set_driving(std::int64_t step) {
  const double factor = setup.waveform.at(static_cast<double>(step) * setup.time_step);
  lattice.set_body_force(scale(factor / units.force_density(), setup.body_force));
  const auto& openings = setup.domain.openings;
  const bool by_velocity = std::any_of(openings.begin(), openings.end(),
                                       [](const Opening& opening) { return opening.kind == Opening::Kind::velocity; });
  const int walls = first_opening_kind - 1;
  for (int wall = 0; wall < walls; ++wall) lattice.set_boundary_factor(wall, factor);
  for (std::size_t n = 0; n < openings.size(); ++n) {
    const bool pulsates = openings[n].kind == Opening::Kind::velocity || !by_velocity;
    lattice.set_boundary_factor(walls + static_cast<int>(n), pulsates ? factor : 1.0);
  }
}

void Simulation::State::restore(CheckpointFile& file, const CheckpointHeader& header) {
  make_coupling();
  flow::load_fluid(lattice, communicator, file);
  departures.restore(header.departures);
  load_cells(cells, setup.cells, departures.all(), file, communicator);
  // An explicit scheme follows the fluid at the places where it has spread; no vertex has moved since.
  if (link) link->locate(cells, 0);
  mark_interior();
  audit.restore(communicator.rank() == 0 ? header.audit : MomentumAudit::Record{});
  earlier = header.counters;
  failures = header.failures;
  for (const CellFailure& failure : failures) failed_cells.insert(failure.id);
  steps = header.step;
  if (!setup.waveform.is_constant()) set_driving(steps - steps % setup.coupling.steps_per_solve);
}

void Simulation::save(CheckpointWriter& file, CheckpointHeader& header) const {
  const State& s = *state_;
  save_fluid(s.lattice, s.communicator, file);
  save_placed(s.setup.cells, s.communicator, file);
  save_centres(s.cells, s.setup.cells, s.departures.all(), file);
  save_cells(s.cells, s.setup.cells, s.departures.all(), file, s.communicator);
  header.step = s.steps;
  header.time_us = time_us();
  header.backend = s.setup.backend;
  header.counters = counters();
  header.failures = s.failures;
  header.departures = s.departures.all();
  header.audit = s.audit.record(s.communicator);
}

void Simulation::step() {
  State& s = *state_;
  if (!s.setup.waveform.is_constant() && (!s.coupling || s.solves_now())) s.drive();
  if (s.coupling) s.load_fluid();
  {
    const Stopwatch watch(s.counters.fluid_seconds);
    s.lattice.step();
  }
  s.audit.count_step(s.lattice);
  ++s.steps;
  if (s.solves_now()) {
    const Stopwatch watch(s.coupling_seconds);
    s.record(s.coupling->follow_fluid());
    s.let_cells_leave();
  }
}

void Simulation::State::load_fluid() {
  const Stopwatch watch(coupling_seconds);
  if (!solves_now()) return coupling->renew_load(static_cast<int>(steps % setup.coupling.steps_per_solve));
  cells.migrate();
  record(coupling->load_fluid());
  mark_interior();
}

/// The fluid holds the forces of those that leave until it is given new ones, before its next step.
void Simulation::State::let_cells_leave() {
  if (departures.let_go(setup, steps, cells, communicator)) mark_interior();
}

/// By the positions that the cells keep until the next solve, and that a checkpoint between the two holds.
void Simulation::State::mark_interior() {
  if (interior) interior->mark(cells);
}

void Simulation::State::record(const CellStepReport& report) {
  counters.cell_steps += report.cell_steps;
  counters.iterations += report.iterations;
  counters.worst_residual_pN = std::max(counters.worst_residual_pN, report.worst_residual);
  constexpr std::int64_t solves_between = 10;
  if (steps / setup.coupling.steps_per_solve % solves_between == 0) {
    counters.worst_volume_error = std::max(counters.worst_volume_error, own_volume_error());
  }
  if (communicator.any(!report.failures.empty())) record_failures(report.failures);
}

/// Makes every rank know the failures of all, in order of id. A cell is named once, when it first fails.
void Simulation::State::record_failures(const std::vector<LocalFailure>& local) {
  Bytes packed;
  for (const LocalFailure& failure : local) {
    const std::array<int, 3> tag{failure.id, failure.type, static_cast<int>(failure.reason.size())};
    append<int>(packed, tag);
    append<char>(packed, failure.reason);
  }
  std::vector<CellFailure> fresh;
  for (const Bytes& bytes : communicator.all_gather(packed)) {
    for (std::size_t at = 0; at < bytes.size();) {
      std::array<int, 3> tag;
      std::memcpy(tag.data(), bytes.data() + at, sizeof tag);
      at += sizeof tag;
      const auto length = static_cast<std::size_t>(tag[2]);
      const std::string reason(reinterpret_cast<const char*>(bytes.data() + at), length);
      at += length;
      if (failed_cells.insert(tag[0]).second) fresh.push_back({tag[0], tag[1], steps, reason});
    }
  }
  std::sort(fresh.begin(), fresh.end(), [](const CellFailure& a, const CellFailure& b) { return a.id < b.id; });
  failures.insert(failures.end(), fresh.begin(), fresh.end());
}

std::vector<CellSurface> Simulation::State::surfaces() const {
  std::vector<double> positions;
  cells.read("position", positions);
  std::vector<CellSurface> own;
  for (const CellPopulation::Cell& cell : cells.cells()) {
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(3 * cell.first_vertex);
    const auto count = static_cast<std::ptrdiff_t>(3 * cells.vertices_of(cell.type));
    own.push_back({cell.id, cell.type, {first, first + count}});
  }
  return own;
}

const std::vector<CellFailure>& Simulation::failures() const {
  return state_->failures;
}
const std::vector<Departure>& Simulation::departures() const {
  return state_->departures.all();
}
std::int64_t Simulation::steps_done() const {
  return state_->steps;
}
double Simulation::time_us() const {
  return static_cast<double>(state_->steps) * state_->setup.time_step;
}
const Setup& Simulation::setup() const {
  return state_->setup;
}
const Units& Simulation::units() const {
  return state_->units;
}
const Lattice& Simulation::lattice() const {
  return state_->lattice;
}
const Decomposition& Simulation::decomposition() const {
  return state_->decomposition;
}
int Simulation::cell_count() const {
  return static_cast<int>(state_->setup.cells.size() - state_->departures.all().size());
}

std::vector<CellState> Simulation::local_cells() const {
  const CellPopulation& cells = state_->cells;
  std::vector<CellState> states;
  for (const CellPopulation::Cell& cell : cells.cells()) {
    const api::Batch& batch = cells.batch(cell.type);
    const std::int32_t handle = batch.handle();
    CellState& state = states.emplace_back();
    state.id = cell.id;
    state.type = cell.type;
    for (const auto& [field, values] : {std::pair{"position", &state.position}, std::pair{"velocity", &state.velocity},
                                        std::pair{"held_force", &state.force}}) {
      values->resize(3 * cells.vertices_of(cell.type));
      batch.read(field, cell.slot, 1, *values);
    }
    api::check(npfem_batch_measure(handle, "volume", cell.slot, 1, &state.volume, 1));
    api::check(npfem_batch_measure(handle, "area", cell.slot, 1, &state.area, 1));
    const CellOutcome& outcome = cells.outcome(cell);
    state.status = outcome.status;
    state.iterations = outcome.iterations;
    state.residual = outcome.residual;
  }
  return states;
}

std::vector<std::pair<std::string, double>> Simulation::phase_seconds() const {
  const FluidLink::Seconds link = state_->link ? state_->link->seconds() : FluidLink::Seconds{};
  return {{"exchange", link.exchange},
          {"velocity", link.velocity},
          {"interpolation", link.interpolation},
          {"contacts", link.contacts},
          {"cells", state_->coupling_seconds - link.all()},
          {"spreading", link.spreading},
          {"fluid", state_->counters.fluid_seconds}};
}

Counters Simulation::counters() const {
  Counters total = state_->counters;
  std::array<std::int64_t, 2> counts{total.cell_steps, total.iterations};
  state_->communicator.sum(counts);
  total.cell_steps = counts[0];
  total.iterations = counts[1];
  state_->communicator.maximum(std::span(&total.worst_residual_pN, 1));
  total.exchange_seconds = state_->link ? state_->link->seconds().all() : 0;
  total.cell_seconds = state_->coupling_seconds - total.exchange_seconds;

  if (state_->link) total.least_gap_um = state_->link->least_contact_distance();
  total.worst_volume_error = std::max(total.worst_volume_error, state_->own_volume_error());
  std::array<double, 2> worst{-total.least_gap_um, total.worst_volume_error};
  state_->communicator.maximum(worst);

  const Counters& earlier = state_->earlier;
  total.least_gap_um = std::min(-worst[0], earlier.least_gap_um);
  total.worst_volume_error = std::max(worst[1], earlier.worst_volume_error);
  total.cell_steps += earlier.cell_steps;
  total.iterations += earlier.iterations;
  total.worst_residual_pN = std::max(total.worst_residual_pN, earlier.worst_residual_pN);
  total.fluid_seconds += earlier.fluid_seconds;
  total.cell_seconds += earlier.cell_seconds;
  total.exchange_seconds += earlier.exchange_seconds;
  return total;
}

double Simulation::State::own_volume_error() const {
  double worst = 0;
  for (const CellPopulation::Cell& cell : cells.cells()) {
    double volume = 0;
    const std::int32_t handle = cells.batch(cell.type).handle();
    api::check(npfem_batch_measure(handle, "volume", cell.slot, 1, &volume, 1));
    worst = std::max(worst, std::abs(volume / start_volumes[static_cast<std::size_t>(cell.type)] - 1.0));
  }
  return worst;
}

double Simulation::volume_error() const {
  double worst = state_->own_volume_error();
  state_->communicator.maximum(std::span(&worst, 1));
  return worst;
}

double Simulation::momentum_error() const {
  return state_->audit.error(state_->lattice, state_->communicator);
}

std::int64_t Simulation::crossings() const {
  const State& s = *state_;
  return count_crossings(s.setup.domain, s.setup.types, s.communicator, s.surfaces());
}

double Simulation::minimum_gap() const {
  const State& s = *state_;
  return smallest_cell_gap(s.setup.domain, s.setup.types, s.communicator, s.surfaces());
}

double Simulation::minimum_wall_gap() const {
  return smallest_wall_gap(state_->setup.domain, state_->communicator, state_->surfaces());
}

std::uint64_t Simulation::state_hash() const {
  return state_->communicator.sum_hash(state_->lattice.state_hash() + state_->cells.state_hash());
}

}  // namespace npfem::flow
