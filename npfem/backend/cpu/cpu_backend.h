// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/cpu/plan_storage.h"
#include "backend/cpu/precision_check.h"
#include "backend/cpu/state_blocks.h"
#include "backend/cpu/step_factors.h"
#include "backend/cpu/threads.h"
#include "backend/reference/cell_state.h"

namespace npfem::cpu {

/// The fast back end: cells in the SIMD lanes, blocks of cells on the threads, the kernels chosen at run time for the
/// machine's instruction set. Its algorithm is that of the back end "reference", to rounding. A cell's bits depend on
/// the instruction set, the precision and its own state: not on the other cells, its lane, its block or the threads.
class CpuBackend final : public Backend {
 public:
  CpuBackend(std::shared_ptr<const Model> model, const KernelTable& kernels);

  int num_cells() const override { return state_.num_cells(); }
  void add_cells(int count) override;
  void remove_cell(int cell) override;
  void write(Field field, int cell, std::span<const double> values) override;
  void read(Field field, int cell, std::span<double> values) const override;
  void set_patches(std::vector<Patch> patches) override;
  void set_obstacles(std::vector<LineageObstacle> obstacles) override { obstacles_ = std::move(obstacles); }
  void step(const SolverOptions& options) override;
  void relax(const SolverOptions& options, const std::atomic<bool>& stop) override;
  void evaluate() override;
  CellReport report(int cell) const override { return reports_[static_cast<std::size_t>(cell)]; }
  std::span<const double> energies(int cell) const override;

 private:
  template <class H>
  struct StepKind;
  template <class R, class H>
  struct StepPlan;

  /// What a thread keeps from step to step, so that a step allocates nothing.
  struct ThreadScratch {
    AlignedVector<char> workspace;
    std::vector<double> contacts;
    std::vector<int> left;  ///< cells that left their pack

    void require_workspace(std::size_t bytes) {
      if (workspace.size() < bytes) workspace.resize(bytes);
    }
  };
  /// One block of cells to step, the kind of each, and whether one may leave when few of its pack still iterate.
  struct BlockOfCells {
    CellBlock block;
    int first_cell;
    std::span<const int> kinds;
    bool may_leave;
  };

  template <class R>
  const CellPlan<R>& plan();
  void find_mass_sets();
  const StepFactors& factors(const FactorKey& key, bool with_hessian);
  const LineageFactors& lineage_factors(double time_step, double beta);
  CellBlock block_of(StateBlocks& state, std::vector<CellReport>& reports, int block) const;
  CellState cell_state(int cell) const;
  void put_cell_state(int cell, CellState& state);

  /// Masses that a step handles at once: each has factors of some megabytes.
  static constexpr int mass_sets_at_once = 8;
  /// The kinds of cells with the mass sets from `first_set` on: those without a past, then those with one.
  template <class H>
  std::vector<StepKind<H>> kinds_of_step(const SolverOptions& options, int first_set, int sets);
  /// Index of a cell's kind among those; -1: it has other masses.
  int kind_of(int cell, const SolverOptions& options, int first_set, int sets) const;
  std::span<ThreadScratch> scratch_of(int threads);
  void find_contacts(const CellBlock& block, std::vector<double>& contacts) const;
  template <class R, class H>
  void step_in(const SolverOptions& options, void (*kernel)(const StepTask<R, H>&), int cells_per_call);
  template <class R, class H>
  void step_kinds(const StepPlan<R, H>& step, int threads);
  template <class R, class H>
  void step_block(const StepPlan<R, H>& step, const BlockOfCells& cells, ThreadScratch& scratch);
  template <class R, class H>
  void step_stragglers(const StepPlan<R, H>& step, int threads);
  bool takes_newton(const SolverOptions& options, CellStatus status) const;
  void finish_by_newton(const SolverOptions& options);

  std::shared_ptr<const Model> model_;
  const KernelTable& kernels_;
  StateBlocks state_;
  std::vector<CellReport> reports_;  // whole blocks
  std::vector<double> energies_;     // per cell, in the order of Model::energy_names()
  std::vector<Patch> patches_;
  std::vector<LineageObstacle> obstacles_;

  std::unique_ptr<PlanStorage<double>> plan_double_;
  std::unique_ptr<PlanStorage<float>> plan_float_;
  std::optional<StiffestForce> stiffest_;        // known from the first step in float
  std::vector<double> solid_mass_, rest_shape_;  // in the kernels' order

  std::vector<Eigen::VectorXd> mass_sets_;  // ambient masses that occur, fg
  std::vector<int> mass_set_of_;            // by cell
  bool masses_are_known_ = false;
  std::unique_ptr<RestHessian> rest_hessian_;
  std::vector<std::unique_ptr<StepFactors>> factors_;
  std::unique_ptr<LineageFactors> lineage_factors_;

  std::vector<int> kinds_;  // by cell, of the step being taken
  std::vector<ThreadScratch> scratch_;
};

template <>
const CellPlan<double>& CpuBackend::plan();
template <>
const CellPlan<float>& CpuBackend::plan();

}  // namespace npfem::cpu
