// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <memory>
#include <vector>

#include "backend/backend.h"
#include "backend/reference/cell_state.h"
#include "backend/reference/lineage_step.h"
#include "backend/reference/step_factor.h"

namespace npfem {

/// One thread, double precision, written for reading. It is the specification: where another back end disagrees, this
/// one is right until a derivation proves it wrong. A cell's bits do not depend on the other cells of the batch.
class ReferenceBackend final : public Backend {
 public:
  explicit ReferenceBackend(std::shared_ptr<const Model> model);

  int num_cells() const override { return static_cast<int>(cells_.size()); }
  void add_cells(int count) override;
  void remove_cell(int cell) override;
  void write(Field field, int cell, std::span<const double> values) override;
  void read(Field field, int cell, std::span<double> values) const override;
  void set_patches(std::vector<Patch> patches) override;
  void set_obstacles(std::vector<LineageObstacle> obstacles) override { obstacles_ = std::move(obstacles); }
  void step(const SolverOptions& options) override;
  void relax(const SolverOptions& options, const std::atomic<bool>& stop) override;
  void evaluate() override;
  CellReport report(int cell) const override { return cells_[static_cast<std::size_t>(cell)].report; }
  std::span<const double> energies(int cell) const override { return cells_[static_cast<std::size_t>(cell)].energies; }

 private:
  /// A factor and what it was made for: it serves every cell with the same masses and the same h of its step.
  struct CachedFactor {
    double h;  // us
    Eigen::VectorXd ambient_mass;
    std::unique_ptr<const StepFactor> factor;
  };
  const StepFactor& step_factor(double h, const Eigen::VectorXd& ambient_mass);
  const LineageFactors& lineage_factors(double time_step, double beta);

  std::shared_ptr<const Model> model_;
  std::vector<CellState> cells_;
  std::vector<Patch> patches_;
  std::vector<LineageObstacle> obstacles_;
  std::vector<CachedFactor> factors_;
  std::unique_ptr<const LineageFactors> lineage_factors_;
  double lineage_time_step_ = 0, lineage_beta_ = 0;
};

}  // namespace npfem
