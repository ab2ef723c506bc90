// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backend/backend.h"
#include "batch/operation_count.h"

namespace npfem {

/// N cells of one model on one back end: the mutable state and its settings. One thread at a time, except
/// request_stop(). All errors are npfem::Error and leave the batch as it was.
class Batch {
 public:
  /// New cells have the model's initial shape, at rest, without loads.
  Batch(std::shared_ptr<const Model> model, std::string_view backend, int cells);

  const Model& model() const { return *model_; }
  int num_cells() const { return backend_->num_cells(); }
  int add_cells(int count);
  void remove_cell(int cell);

  const SolverOptions& options() const { return options_; }
  SolverOptions& options() { return options_; }

  /// A written velocity starts a new motion: the lag fields of the cell become zero.
  /// Fields of `count` cells from `first`; values.size() = count * vertices * components(field).
  void write(Field field, int first, int count, std::span<const double> values);
  void read(Field field, int first, int count, std::span<double> values) const;

  void add_patch(std::span<const int> vertices, double stiffness);
  void clear_patches();
  int num_patches() const { return static_cast<int>(patches_.size()); }
  void set_obstacles(std::vector<LineageObstacle> obstacles) { backend_->set_obstacles(std::move(obstacles)); }

  /// Each returns the number of failed cells.
  int step(int steps);
  int step_for_ms(double milliseconds, int& steps_done);
  int relax();
  void evaluate();
  void request_stop() { stop_.store(true, std::memory_order_relaxed); }

  CellReport report(int cell) const;
  /// One sentence on how the last step of the cell ended.
  std::string status_text(int cell) const;
  /// A measure by key (npfem.h, npfem_batch_measure) of one cell. Energies need evaluate() at the present positions.
  double measure(std::string_view key, int cell) const;
  std::uint64_t state_hash(int cell) const;

  int pack_length() const;
  void pack(int cell, std::span<double> values) const;
  void unpack(int cell, std::span<const double> values);

 private:
  void require_cells(int first, int count) const;
  void require_length(std::size_t found, std::size_t needed, const std::string& what) const;
  void require_steppable();
  void require_masses();
  void require_no_fluid() const;
  void forget_past(int cell);
  int num_failed() const;
  std::vector<double> field_of(Field field, int cell) const;
  double operations_of_last_step(int cell) const;

  std::shared_ptr<const Model> model_;
  std::unique_ptr<Backend> backend_;
  SolverOptions options_;
  std::vector<Patch> patches_;
  bool masses_are_positive_ = false;                  ///< no mass has changed since they were looked at
  bool energies_are_current_ = false;                 ///< no cell has moved since evaluate()
  mutable std::optional<OperationCount> operations_;  ///< of the model; counted when first asked for
  std::atomic<bool> stop_{false};
};

/// Field by its name in npfem.h. Throws Error(unknown_name).
Field field_by_name(std::string_view name);

}  // namespace npfem
