// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/cpu_backend.h"

#include <algorithm>

#include "backend/reference/relax.h"

namespace npfem::cpu {
namespace {

std::vector<double> solid_mass_in(std::span<const int> order, const Model& model) {
  std::vector<double> mass;
  for (const int v : order) mass.push_back(model.solid_mass[static_cast<std::size_t>(v)]);
  return mass;
}

std::vector<double> centred_shape_in(std::span<const int> order, const Model& model) {
  Point centre{0, 0, 0};
  for (const Point& x : model.initial) {
    for (std::size_t c = 0; c < 3; ++c) centre[c] += x[c] / static_cast<double>(model.initial.size());
  }
  std::vector<double> shape;
  for (const int v : order) {
    for (std::size_t c = 0; c < 3; ++c) shape.push_back(model.initial[static_cast<std::size_t>(v)][c] - centre[c]);
  }
  return shape;
}

/// Places in the kernels' ledger of the energies that the model evaluates, in the order of Model::energy_names().
std::vector<int> energy_places(const Model& model) {
  std::vector<int> places;
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (model.block<E>().size() > 0) places.push_back(index_in<E>(ElementEnergies{}));
  });
  for_each_energy(GroupEnergies{}, [&](auto tag) {
    using G = typename decltype(tag)::type;
    if (model.group_block<G>().size() > 0) places.push_back(first_group_energy + index_in<G>(GroupEnergies{}));
  });
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (cell_term<E>(model)) places.push_back(first_cell_energy + index_in<E>(CellEnergies{}));
  });
  return places;
}

std::span<double> numbers(VertexField& field) {
  return {field.data(), static_cast<std::size_t>(field.size())};
}

}  // namespace

CpuBackend::CpuBackend(std::shared_ptr<const Model> model, const KernelTable& kernels)
    : model_(std::move(model)),
      kernels_(kernels),
      state_(elimination_order(model_->weight), model_->initial, kernels.float_lanes),
      solid_mass_(solid_mass_in(state_.order(), *model_)),
      rest_shape_(centred_shape_in(state_.order(), *model_)) {}

template <>
const CellPlan<double>& CpuBackend::plan() {
  if (!plan_double_) plan_double_ = std::make_unique<PlanStorage<double>>(*model_, state_.order());
  return plan_double_->plan();
}
template <>
const CellPlan<float>& CpuBackend::plan() {
  if (!plan_float_) plan_float_ = std::make_unique<PlanStorage<float>>(*model_, state_.order());
  return plan_float_->plan();
}

void CpuBackend::add_cells(int count) {
  state_.resize(num_cells() + count);
  reports_.resize(static_cast<std::size_t>(state_.num_blocks() * state_.lanes()));
  energies_.resize(static_cast<std::size_t>(num_cells()) * model_->energy_names().size(), 0.0);
  masses_are_known_ = false;
}

void CpuBackend::remove_cell(int cell) {
  const auto c = static_cast<std::ptrdiff_t>(cell),
             energies = static_cast<std::ptrdiff_t>(model_->energy_names().size());
  for (int k = cell; k + 1 < num_cells(); ++k) state_.copy(k + 1, k);
  reports_.erase(reports_.begin() + c);
  reports_.emplace_back();
  energies_.erase(energies_.begin() + c * energies, energies_.begin() + (c + 1) * energies);
  state_.resize(num_cells() - 1);
  masses_are_known_ = false;
}

void CpuBackend::write(Field field, int cell, std::span<const double> values) {
  state_.write(field, cell, values);
  if (field == Field::ambient_mass) {
    masses_are_known_ = false;
    if (state_.has(Field::ambient_mass)) state_.require(Field::held_force);
  }
}

void CpuBackend::read(Field field, int cell, std::span<double> values) const {
  state_.read(field, cell, values);
}

void CpuBackend::set_patches(std::vector<Patch> patches) {
  // Patches known before keep the shape in which they were tied.
  if (!patches.empty()) state_.require(Field::tied_at);
  std::vector<double> position(3 * static_cast<std::size_t>(model_->num_vertices())), tied(position.size());
  for (int c = 0; c < num_cells() && patches.size() > patches_.size(); ++c) {
    state_.read(Field::position, c, position);
    state_.read(Field::tied_at, c, tied);
    for (std::size_t p = patches_.size(); p < patches.size(); ++p) {
      for (const int v : patches[p].vertices) std::copy_n(position.begin() + 3 * v, 3, tied.begin() + 3 * v);
    }
    state_.write(Field::tied_at, c, tied);
  }
  patches_ = std::move(patches);
  factors_.clear();
}

std::span<const double> CpuBackend::energies(int cell) const {
  const std::size_t count = model_->energy_names().size();
  return {energies_.data() + static_cast<std::size_t>(cell) * count, count};
}

void CpuBackend::find_mass_sets() {
  if (masses_are_known_) return;
  const auto n = static_cast<Eigen::Index>(model_->num_vertices());
  Eigen::VectorXd mass(n);
  std::vector<Eigen::VectorXd> sets;
  mass_set_of_.assign(static_cast<std::size_t>(num_cells()), 0);
  for (int c = 0; c < num_cells(); ++c) {
    state_.read(Field::ambient_mass, c, {mass.data(), static_cast<std::size_t>(n)});
    const auto found = std::find(sets.begin(), sets.end(), mass);
    mass_set_of_[static_cast<std::size_t>(c)] = static_cast<int>(found - sets.begin());
    if (found == sets.end()) sets.push_back(mass);
  }
  if (sets != mass_sets_) factors_.clear();
  mass_sets_ = std::move(sets);
  masses_are_known_ = true;
}

const StepFactors& CpuBackend::factors(const FactorKey& key, bool with_hessian) {
  for (auto cached = factors_.begin(); cached != factors_.end(); ++cached) {
    if (!((*cached)->key() == key)) continue;
    if ((*cached)->has_hessian() || !with_hessian) {
      // The last used is the last to go: a step holds several at once.
      std::rotate(cached, cached + 1, factors_.end());
      return *factors_.back();
    }
    factors_.erase(cached);
    break;
  }
  if (with_hessian && !rest_hessian_) rest_hessian_ = std::make_unique<RestHessian>(*model_, state_.order());
  Eigen::VectorXd mass = model_->solid_masses();
  if (key.mass_set >= 0) mass += mass_sets_[static_cast<std::size_t>(key.mass_set)];
  constexpr std::size_t kept = 2 * mass_sets_at_once + 2;  // with and without a past, and a time step in passing
  if (factors_.size() >= kept) factors_.erase(factors_.begin());
  factors_.push_back(std::make_unique<StepFactors>(*model_, state_.order(), key, mass, patches_,
                                                   with_hessian ? rest_hessian_.get() : nullptr));
  return *factors_.back();
}

const LineageFactors& CpuBackend::lineage_factors(double time_step, double beta) {
  if (!lineage_factors_ || !lineage_factors_->is_for(time_step, beta))
    lineage_factors_ = std::make_unique<LineageFactors>(*model_, state_.order(), time_step, beta);
  return *lineage_factors_;
}

CellBlock CpuBackend::block_of(StateBlocks& state, std::vector<CellReport>& reports, int block) const {
  CellBlock b;
  b.stride = state.lanes();
  b.position = state.block(Field::position, block);
  b.velocity = state.block(Field::velocity, block);
  b.external_force = state.block(Field::external_force, block);
  b.contact_stiffness = state.block(Field::contact_stiffness, block);
  b.ambient_velocity = state.block(Field::ambient_velocity, block);
  b.ambient_mass = state.block(Field::ambient_mass, block);
  b.held_force = state.block(Field::held_force, block);
  b.lag_velocity = state.block(Field::lag_velocity, block);
  b.lag_acceleration = state.block(Field::lag_acceleration, block);
  b.tied_at = patches_.empty() ? nullptr : state.block(Field::tied_at, block);
  b.report = reports.data() + static_cast<std::ptrdiff_t>(block) * state.lanes();
  return b;
}

void CpuBackend::relax(const SolverOptions& options, const std::atomic<bool>& stop) {
  const Eigen::VectorXd anchor =
      Eigen::VectorXd::Constant(model_->num_vertices(), 1e-6 * model_->weight.diagonal().mean());
  const StepFactor factor(*model_, anchor, {1, 0}, patches_);
  for_each_piece(num_cells(), thread_count(options.threads, num_cells()), [&](int cell, int) {
    if (stop.load(std::memory_order_relaxed)) return;
    CellState state = cell_state(cell);
    relax_cell(*model_, factor, patches_, options, state);
    reports_[static_cast<std::size_t>(cell)] = state.report;
    put_cell_state(cell, state);
  });
}

CellState CpuBackend::cell_state(int cell) const {
  CellState state;
  const auto n = static_cast<Eigen::Index>(model_->num_vertices());
  const auto get = [&](Field field, VertexField& values) {
    values.resize(n, 3);
    state_.read(field, cell, numbers(values));
  };
  get(Field::position, state.position);
  get(Field::velocity, state.velocity);
  get(Field::external_force, state.external_force);
  get(Field::ambient_velocity, state.ambient_velocity);
  get(Field::held_force, state.held_force);
  get(Field::lag_velocity, state.lag_velocity);
  get(Field::lag_acceleration, state.lag_acceleration);
  get(Field::tied_at, state.tied_at);
  for (const auto& [field, values] :
       {std::pair{Field::ambient_mass, &state.ambient_mass}, {Field::contact_stiffness, &state.contact_stiffness}}) {
    values->resize(n);
    state_.read(field, cell, {values->data(), static_cast<std::size_t>(n)});
  }
  return state;
}

/// What a step or a relaxation changes. Fields that are zero everywhere have no memory and stay so.
void CpuBackend::put_cell_state(int cell, CellState& state) {
  state_.write(Field::position, cell, numbers(state.position));
  state_.write(Field::velocity, cell, numbers(state.velocity));
  for (const auto& [field, values] : {std::pair{Field::held_force, &state.held_force},
                                      {Field::lag_velocity, &state.lag_velocity},
                                      {Field::lag_acceleration, &state.lag_acceleration}}) {
    if (state_.has(field)) state_.write(field, cell, numbers(*values));
  }
}

void CpuBackend::evaluate() {
  state_.require(Field::elastic_force);
  const CellPlan<double>& cell_plan = plan<double>();
  const std::size_t bytes = kernels_.workspace_bytes(cell_plan.num_vertices, 0, 0);
  const std::vector<int> places = energy_places(*model_);
  const int lanes = state_.lanes();
  ThreadScratch& scratch = scratch_of(1).front();
  scratch.require_workspace(bytes);
  std::vector<double> energies(static_cast<std::size_t>(num_energies * lanes));
  for (int block = 0; block < state_.num_blocks(); ++block) {
    EvaluateTask<double> task{
        &cell_plan,      block_of(state_, reports_, block), 0, state_.block(Field::elastic_force, block),
        energies.data(), scratch.workspace.data()};
    for (; task.first_lane < lanes; task.first_lane += kernels_.double_lanes) kernels_.evaluate(task);
    for (int lane = 0; lane < lanes && block * lanes + lane < num_cells(); ++lane) {
      const auto cell = static_cast<std::size_t>(block * lanes + lane);
      for (std::size_t e = 0; e < places.size(); ++e)
        energies_[cell * places.size() + e] = energies[static_cast<std::size_t>(places[e] * lanes + lane)];
    }
  }
}

std::span<CpuBackend::ThreadScratch> CpuBackend::scratch_of(int threads) {
  if (scratch_.size() < static_cast<std::size_t>(threads)) scratch_.resize(static_cast<std::size_t>(threads));
  return scratch_;
}

}  // namespace npfem::cpu
