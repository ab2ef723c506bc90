// SPDX-License-Identifier: MPL-2.0
// One implicit step of all cells of the back end cpu: which cells go through which kernel, on which thread.
#include <algorithm>

#include "backend/cpu/cpu_backend.h"
#include "backend/reference/lineage_contacts.h"
#include "backend/reference/time_step.h"

namespace npfem::cpu {
namespace {

/// `differencing`: of a cell with a past, or of one without (see reference/time_step.h).
StepSettings settings_from(const SolverOptions& o, const Differencing& differencing) {
  StepSettings s{};
  s.time_step = o.time_step, s.lead = differencing.h, s.past = differencing.past;
  s.looks_back = o.integrator == Integrator::bdf2;
  s.tolerance = o.tolerance, s.residual_bound = o.residual_bound;
  s.max_iterations = o.max_iterations, s.history = o.history, s.max_line_search = o.max_line_search;
  s.always_blocks = o.matrix == MatrixChoice::hessian_matrix;
  s.lineage = o.lineage;
  s.lineage_alpha = o.lineage_alpha, s.lineage_beta = o.lineage_beta, s.lineage_tolerance = o.lineage_tolerance;
  s.lineage_window = o.lineage_window, s.lineage_attempts = o.lineage_attempts;
  s.lineage_armijo = o.lineage_armijo, s.lineage_curvature = o.lineage_curvature;
  return s;
}

/// The patches in the kernels' numbers.
template <class R>
class PatchViews {
 public:
  PatchViews(std::span<const Patch> patches, std::span<const int> order) {
    const std::vector<int> place = places_in(order);
    vertices_.reserve(patches.size());
    for (const Patch& patch : patches) {
      auto& vertices = vertices_.emplace_back();
      for (const int v : patch.vertices) vertices.push_back(place[static_cast<std::size_t>(v)]);
      views_.push_back({static_cast<int>(vertices.size()), vertices.data(), static_cast<R>(patch.stiffness)});
    }
  }
  const PatchView<R>* data() const { return views_.data(); }
  int count() const { return static_cast<int>(views_.size()); }

 private:
  std::vector<std::vector<int>> vertices_;
  std::vector<PatchView<R>> views_;
};

}  // namespace

/// What the cells of one kind share in a step: all those with the same masses, with or without a past.
template <class H>
struct CpuBackend::StepKind {
  StepSettings settings;
  StepMatrices<H> matrices;
};

/// One step of all cells in numbers R and H.
template <class R, class H>
struct CpuBackend::StepPlan {
  std::vector<StepKind<H>> kinds;
  LineageMatrices<R> lineage;
  PatchViews<R> patches;
  void (*kernel)(const StepTask<R, H>&);
  int cells_per_call;
  bool looks_for_contacts, may_leave;
};

template <class H>
std::vector<CpuBackend::StepKind<H>> CpuBackend::kinds_of_step(const SolverOptions& options, int first_set, int sets) {
  std::vector<StepKind<H>> kinds;
  for (const bool past : {false, true}) {
    if (past && options.integrator != Integrator::bdf2) continue;
    StepSettings settings = settings_from(options, past ? bdf2_differencing(options) : euler_differencing(options));
    settings.leave_short = takes_newton(options, CellStatus::iteration_cap);
    for (int set = first_set; set < first_set + sets; ++set) {
      const FactorKey key = options.lineage
                                ? FactorKey{options.time_step, -1, 1 + options.lineage_beta / options.time_step}
                                : FactorKey{settings.lead, set, 1};
      const bool with_hessian = !options.lineage && options.matrix != MatrixChoice::scalar_matrix;
      const StepFactors& matrices = factors(key, with_hessian);
      if (options.precision != Precision::double_precision && !matrices.fits_float()) refuse_factor_in_float(options);
      kinds.push_back({settings, matrices.template view<H>()});
    }
  }
  return kinds;
}

/// For each vertex of a block the nearest obstacle point within its threshold: the plane's point (3), its normal (3)
/// and the weight, 0 where there is none.
void CpuBackend::find_contacts(const CellBlock& block, std::vector<double>& contacts) const {
  const int n = model_->num_vertices(), lanes = block.stride;
  contacts.assign(static_cast<std::size_t>(7 * n * lanes), 0.0);
  const double* const position = block.position;
  const auto at = [lanes](int row, int lane) { return static_cast<std::size_t>(row * lanes + lane); };
  for (int lane = 0; lane < lanes; ++lane) {
    for (int v = 0; v < n; ++v) {
      const Point x{position[at(3 * v, lane)], position[at(3 * v + 1, lane)], position[at(3 * v + 2, lane)]};
      const NearestObstacle nearest = nearest_obstacle(obstacles_, x);
      if (!nearest.obstacle || nearest.distance > nearest.obstacle->threshold) continue;
      const LineageObstacle& o = *nearest.obstacle;
      for (int c = 0; c < 3; ++c) {
        const auto axis = static_cast<std::size_t>(c);
        contacts[at(7 * v + c, lane)] = o.target[axis] + o.stand_off * o.normal[axis];
        contacts[at(7 * v + 3 + c, lane)] = o.normal[axis];
      }
      contacts[at(7 * v + 6, lane)] = o.weight;
    }
  }
}

int CpuBackend::kind_of(int cell, const SolverOptions& options, int first_set, int sets) const {
  const int set = mass_set_of_[static_cast<std::size_t>(cell)] - first_set;
  if (set < 0 || set >= sets) return -1;
  if (options.integrator != Integrator::bdf2) return set;
  const bool has_past = !state_.is_zero(Field::lag_velocity, cell) || !state_.is_zero(Field::lag_acceleration, cell);
  return has_past ? set + sets : set;
}

template <class R, class H>
void CpuBackend::step_block(const StepPlan<R, H>& step, const BlockOfCells& cells, ThreadScratch& scratch) {
  const CellPlan<R>& cell_plan = plan<R>();
  const std::size_t bytes = kernels_.workspace_bytes(cell_plan.num_vertices, step.kinds.front().settings.history,
                                                     step.kinds.front().settings.lineage_window);
  scratch.require_workspace(bytes);
  StepTask<R, H> task{};
  task.plan = &cell_plan;
  task.lineage = &step.lineage;
  task.patches = step.patches.data();
  task.num_patches = step.patches.count();
  task.solid_mass = solid_mass_.data();
  task.rest_shape = rest_shape_.data();
  task.block = cells.block;
  task.workspace = scratch.workspace.data();
  if (step.looks_for_contacts) {
    find_contacts(cells.block, scratch.contacts);
    task.block.contact = scratch.contacts.data();
  }
  const auto count = static_cast<int>(cells.kinds.size());
  for (task.first_lane = 0; task.first_lane < count; task.first_lane += step.cells_per_call) {
    for (std::size_t k = 0; k < step.kinds.size(); ++k) {
      task.active = 0;
      for (int l = 0; l < step.cells_per_call && task.first_lane + l < count; ++l) {
        if (cells.kinds[static_cast<std::size_t>(task.first_lane + l)] == static_cast<int>(k)) task.active |= 1u << l;
      }
      if (task.active == 0) continue;
      task.settings = &step.kinds[k].settings;
      task.matrices = &step.kinds[k].matrices;
      std::uint32_t left = 0;
      task.left = cells.may_leave ? &left : nullptr;
      step.kernel(task);
      for (int l = 0; l < step.cells_per_call; ++l) {
        if ((left >> l & 1u) != 0) scratch.left.push_back(cells.first_cell + task.first_lane + l);
      }
    }
  }
}

template <class R, class H>
void CpuBackend::step_in(const SolverOptions& options, void (*kernel)(const StepTask<R, H>&), int cells_per_call) {
  LineageMatrices<R> lineage;
  if (options.lineage) lineage = lineage_factors(options.time_step, options.lineage_beta).view(R{});
  plan<R>();
  kinds_.resize(static_cast<std::size_t>(num_cells()));
  const int all_sets = static_cast<int>(mass_sets_.size());
  for (int first_set = 0; first_set < all_sets; first_set += mass_sets_at_once) {
    const int sets = std::min(mass_sets_at_once, all_sets - first_set);
    const StepPlan<R, H> step{kinds_of_step<H>(options, first_set, sets),
                              lineage,
                              {patches_, state_.order()},
                              kernel,
                              cells_per_call,
                              options.lineage && !obstacles_.empty(),
                              !options.lineage && cells_per_call > 1 && num_cells() > cells_per_call};
    for (int cell = 0; cell < num_cells(); ++cell)
      kinds_[static_cast<std::size_t>(cell)] = kind_of(cell, options, first_set, sets);
    step_kinds(step, thread_count(options.threads, state_.num_blocks()));
  }
}

template <class R, class H>
void CpuBackend::step_kinds(const StepPlan<R, H>& step, int threads) {
  const std::span<ThreadScratch> scratch = scratch_of(threads);
  for (ThreadScratch& s : scratch) s.left.clear();
  for_each_piece(state_.num_blocks(), threads, [&](int block, int thread) {
    const int first = block * state_.lanes(), count = std::min(state_.lanes(), num_cells() - first);
    const auto kinds = std::span(kinds_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
    step_block(step, {block_of(state_, reports_, block), first, kinds, step.may_leave},
               scratch[static_cast<std::size_t>(thread)]);
  });
  if (step.may_leave) step_stragglers(step, threads);
}

/// Cells that the rest of their pack would have waited for start their step again in full packs. An iteration does not
/// depend on the neighbours, so they pass through the same numbers as if they had stayed.
template <class R, class H>
void CpuBackend::step_stragglers(const StepPlan<R, H>& step, int threads) {
  std::vector<int> left;
  for (ThreadScratch& scratch : scratch_) left.insert(left.end(), scratch.left.begin(), scratch.left.end());
  std::sort(left.begin(), left.end());
  while (!left.empty()) {
    const auto count = static_cast<int>(left.size());
    StateBlocks gathered(std::vector<int>(state_.order().begin(), state_.order().end()), model_->initial,
                         state_.lanes());
    gathered.resize(count);
    std::vector<int> kinds;
    for (int k = 0; k < count; ++k) {
      gathered.copy_from(state_, left[static_cast<std::size_t>(k)], k);
      kinds.push_back(kinds_[static_cast<std::size_t>(left[static_cast<std::size_t>(k)])]);
    }
    std::vector<CellReport> reports(static_cast<std::size_t>(gathered.num_blocks() * gathered.lanes()));
    for (ThreadScratch& scratch : scratch_) scratch.left.clear();
    const bool may_leave = count > step.cells_per_call;
    for_each_piece(gathered.num_blocks(), std::min(threads, gathered.num_blocks()), [&](int block, int thread) {
      const int first = block * gathered.lanes(), some = std::min(gathered.lanes(), count - first);
      const auto their = std::span(kinds).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(some));
      step_block(step, {block_of(gathered, reports, block), first, their, may_leave},
                 scratch_[static_cast<std::size_t>(thread)]);
    });
    std::vector<int> again;
    for (ThreadScratch& scratch : scratch_) again.insert(again.end(), scratch.left.begin(), scratch.left.end());
    std::sort(again.begin(), again.end());
    std::vector<int> next;
    for (int k = 0; k < count; ++k) {
      const int cell = left[static_cast<std::size_t>(k)];
      if (std::binary_search(again.begin(), again.end(), k)) {
        next.push_back(cell);
      } else {
        state_.copy_from(gathered, k, cell);
        reports_[static_cast<std::size_t>(cell)] = reports[static_cast<std::size_t>(k)];
      }
    }
    left = std::move(next);
  }
}

void CpuBackend::step(const SolverOptions& options) {
  if (options.precision == Precision::single_precision) {
    if (!stiffest_) stiffest_ = stiffest_force(*model_);
    require_forces_in_float(*stiffest_, options);
  }
  find_mass_sets();
  if (options.integrator == Integrator::bdf2) {
    state_.require(Field::lag_velocity);
    state_.require(Field::lag_acceleration);
  }
  const bool lone = options.lone_cells != 0;
  const auto step_with = [&](auto kernel, auto lone_kernel, int lanes) {
    step_in(options, lone ? lone_kernel : kernel, lone ? 1 : lanes);
  };
  switch (options.precision) {
    case Precision::double_precision:
      step_with(kernels_.step_double, kernels_.lone_step_double, kernels_.double_lanes);
      break;
    case Precision::mixed_precision:
      step_with(kernels_.step_mixed, kernels_.lone_step_mixed, kernels_.double_lanes);
      break;
    default:
      step_with(kernels_.step_float, kernels_.lone_step_float, kernels_.float_lanes);
  }
  if (!options.lineage) finish_by_newton(options);
}

/// In single precision a cell may stop short of the tolerance because its digits end there; double would not help it in
/// the next step, so only one that would fail is worth Newton's price.
bool CpuBackend::takes_newton(const SolverOptions& options, CellStatus status) const {
  if (options.precision == Precision::single_precision && !has_failed(status)) return false;
  return needs_newton(*model_, options, status);
}

/// Cells that the kernels could not bring to the tolerance have not moved; Newton's method takes their step.
void CpuBackend::finish_by_newton(const SolverOptions& options) {
  std::vector<int> left;
  for (int cell = 0; cell < num_cells(); ++cell) {
    if (takes_newton(options, reports_[static_cast<std::size_t>(cell)].status)) left.push_back(cell);
  }
  if (left.empty()) return;
  SolverOptions newton_only = options;
  newton_only.max_iterations = 0;
  const auto pieces = static_cast<int>(left.size());
  for_each_piece(pieces, thread_count(options.threads, pieces), [&](int piece, int) {
    const int cell = left[static_cast<std::size_t>(piece)];
    CellReport& report = reports_[static_cast<std::size_t>(cell)];
    const CellReport before = report;
    CellState state = cell_state(cell);
    const double h = differencing(options, state).h;
    const StepFactor factor(*model_, (model_->solid_masses() + state.ambient_mass) / (h * h), {1, 1 / h}, patches_);
    time_step(*model_, factor, patches_, newton_only, state);
    report = state.report;
    report.iterations += before.iterations;
    report.hessian_iterations = before.hessian_iterations;
    report.evaluations += before.evaluations;
    put_cell_state(cell, state);
  });
}

}  // namespace npfem::cpu
