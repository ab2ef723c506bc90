// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/reference_backend.h"

#include <algorithm>

#include "backend/reference/elasticity.h"
#include "backend/reference/relax.h"
#include "backend/reference/time_step.h"

namespace npfem {
namespace {

/// The numbers of one field of a cell (const where the cell is).
template <class State>
auto* field_data(State& cell, Field field) {
  switch (field) {
    case Field::position:
      return cell.position.data();
    case Field::velocity:
      return cell.velocity.data();
    case Field::external_force:
      return cell.external_force.data();
    case Field::ambient_velocity:
      return cell.ambient_velocity.data();
    case Field::held_force:
      return cell.held_force.data();
    case Field::ambient_mass:
      return cell.ambient_mass.data();
    case Field::contact_stiffness:
      return cell.contact_stiffness.data();
    case Field::lag_velocity:
      return cell.lag_velocity.data();
    case Field::lag_acceleration:
      return cell.lag_acceleration.data();
    default:
      return cell.elastic_force.data();
  }
}

}  // namespace

ReferenceBackend::ReferenceBackend(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

void ReferenceBackend::add_cells(int count) {
  const auto n = static_cast<Eigen::Index>(model_->num_vertices());
  CellState fresh;
  fresh.position = Eigen::Map<const VertexField>(model_->initial.front().data(), n, 3);
  fresh.tied_at = fresh.position;
  for (VertexField* field : {&fresh.velocity, &fresh.external_force, &fresh.ambient_velocity, &fresh.held_force,
                             &fresh.lag_velocity, &fresh.lag_acceleration, &fresh.elastic_force}) {
    field->setZero(n, 3);
  }
  fresh.ambient_mass = fresh.contact_stiffness = Eigen::VectorXd::Zero(n);
  fresh.energies.assign(model_->energy_names().size(), 0.0);
  cells_.resize(cells_.size() + static_cast<std::size_t>(count), fresh);
}

void ReferenceBackend::remove_cell(int cell) {
  cells_.erase(cells_.begin() + cell);
}

void ReferenceBackend::write(Field field, int cell, std::span<const double> values) {
  std::copy(values.begin(), values.end(), field_data(cells_[static_cast<std::size_t>(cell)], field));
}

void ReferenceBackend::read(Field field, int cell, std::span<double> values) const {
  std::copy_n(field_data(cells_[static_cast<std::size_t>(cell)], field), values.size(), values.begin());
}

void ReferenceBackend::set_patches(std::vector<Patch> patches) {
  // Patches known before keep the shape in which they were tied.
  for (std::size_t p = patches_.size(); p < patches.size(); ++p) {
    for (CellState& cell : cells_) {
      for (const int i : patches[p].vertices) cell.tied_at.row(i) = cell.position.row(i);
    }
  }
  patches_ = std::move(patches);
  factors_.clear();
}

const StepFactor& ReferenceBackend::step_factor(double h, const Eigen::VectorXd& ambient_mass) {
  for (const CachedFactor& cached : factors_) {
    if (cached.h == h && cached.ambient_mass == ambient_mass) return *cached.factor;
  }
  constexpr std::size_t kept = 4;  // a batch has one set of masses and two h, or more while a host changes them
  if (factors_.size() == kept) factors_.erase(factors_.begin());
  const Eigen::VectorXd inertia = (model_->solid_masses() + ambient_mass) / (h * h);
  factors_.push_back(
      {h, ambient_mass, std::make_unique<StepFactor>(*model_, inertia, StepFactor::Scales{1.0, 1 / h}, patches_)});
  return *factors_.back().factor;
}

const LineageFactors& ReferenceBackend::lineage_factors(double time_step, double beta) {
  if (!lineage_factors_ || lineage_time_step_ != time_step || lineage_beta_ != beta) {
    const Eigen::VectorXd mass = model_->solid_masses();
    const double per_square = 1 / (time_step * time_step);
    // A factor can be built in place only, not moved.
    lineage_factors_.reset(new LineageFactors{StepFactor(*model_, mass, {time_step * beta, 0}, {}),
                                              StepFactor(*model_, mass * per_square, {1 + beta / time_step, 0}, {})});
    lineage_time_step_ = time_step;
    lineage_beta_ = beta;
  }
  return *lineage_factors_;
}

void ReferenceBackend::step(const SolverOptions& options) {
  for (CellState& cell : cells_) {
    if (options.lineage) {
      lineage_step(*model_, lineage_factors(options.time_step, options.lineage_beta), obstacles_, options, cell);
    } else {
      const StepFactor& factor = step_factor(differencing(options, cell).h, cell.ambient_mass);
      time_step(*model_, factor, patches_, options, cell);
    }
  }
}

void ReferenceBackend::relax(const SolverOptions& options, const std::atomic<bool>& stop) {
  // The weights alone do not resist a translation; a millionth of them on the diagonal makes the matrix definite
  // without being felt, since it only steers the search.
  const Eigen::VectorXd anchor =
      Eigen::VectorXd::Constant(model_->num_vertices(), 1e-6 * model_->weight.diagonal().mean());
  const StepFactor factor(*model_, anchor, {1, 0}, patches_);
  for (CellState& cell : cells_) {
    if (stop.load(std::memory_order_relaxed)) return;
    relax_cell(*model_, factor, patches_, options, cell);
  }
}

void ReferenceBackend::evaluate() {
  for (CellState& cell : cells_) {
    cell.elastic_force.setZero();
    elastic_energy(*model_, cell.position, cell.elastic_force, cell.energies);
    cell.elastic_force *= -1;
  }
}

}  // namespace npfem
