// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/step_factors.h"

#include <Eigen/Dense>

#include "backend/inertia_and_patches.h"
#include "backend/reference/dissipation.h"
#include "model/hessian.h"

namespace npfem::cpu {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Eigen::VectorXd reordered_vector(const Eigen::VectorXd& values, std::span<const int> order) {
  Eigen::VectorXd result(values.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    result.segment<3>(3 * static_cast<Eigen::Index>(k)) = values.segment<3>(3 * order[k]);
  return result;
}

/// Second derivative by the displacements of what viscosity costs in a step of unit length from the initial shape.
Sparse viscous_hessian(const Model& model) {
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  const VertexField start = Eigen::Map<const VertexField>(model.initial.front().data(), n, 3);
  const VertexField still = VertexField::Zero(n, 3);
  return Dissipation(model, start, still, 0, 1).hessian(still, Definite::projected);
}

}  // namespace

RestHessian::RestHessian(const Model& model, std::span<const int> order) {
  const std::span<const double> x(model.initial.front().data(), 3 * model.initial.size());
  sparse = reordered(elastic_hessian(model, x, Definite::projected), order, 3);
  viscous = reordered(viscous_hessian(model), order, 3);
  for (const GlobalStiffness& term : global_stiffness(model, x)) {
    if (term.stiffness > 0) dense.push_back({reordered_vector(term.direction, order), term.stiffness});
  }
}

StepFactors::StepFactors(const Model& model, std::span<const int> order, const FactorKey& key,
                         const Eigen::VectorXd& mass, std::span<const Patch> patches, const RestHessian* hessian)
    : key_(key),
      scalar_(reordered(key.weight_scale * model.weight + (1 / key.lead) * model.viscous_weight +
                            inertia_and_patches(mass / (key.lead * key.lead), patches, 1),
                        order, 1),
              1) {
  if (hessian) add_block(order, mass, patches, *hessian);
}

/// H = S + sum_t k_t a_t a_t^T has H^-1 = S^-1 - Z C Z^T with Z = S^-1 a, C = (diag(1/k) + a^T Z)^-1.
void StepFactors::add_block(std::span<const int> order, const Eigen::VectorXd& mass, std::span<const Patch> patches,
                            const RestHessian& hessian) {
  const auto terms = static_cast<Eigen::Index>(hessian.dense.size());
  Eigen::MatrixXd directions(3 * mass.size(), terms);
  for (Eigen::Index t = 0; t < terms; ++t) directions.col(t) = hessian.dense[static_cast<std::size_t>(t)].direction;
  Eigen::MatrixXd z = directions;
  block_.emplace(hessian.sparse + (1 / key_.lead) * hessian.viscous +
                     reordered(inertia_and_patches(mass / (key_.lead * key_.lead), patches, 3), order, 3),
                 3, &z);
  Eigen::MatrixXd capacity = directions.transpose() * z;
  for (Eigen::Index t = 0; t < terms; ++t) {
    capacity(t, t) += 1 / hessian.dense[static_cast<std::size_t>(t)].stiffness;
    // Padded with zeros to whole registers: a lone cell is read one register after the other.
    AlignedVector<double> padded(static_cast<std::size_t>(z.rows()) + 16, 0.0);
    std::copy_n(z.col(t).data(), z.rows(), padded.begin());
    direction_float_.emplace_back(padded.begin(), padded.end());
    direction_.push_back(std::move(padded));
  }
  weight_ = capacity.inverse();
}

template <class H>
StepMatrices<H> StepFactors::view() const {
  StepMatrices<H> matrices;
  matrices.scalar = scalar_.view(H{});
  if (!block_) return matrices;
  matrices.block = block_->view(H{});
  matrices.has_block = true;
  matrices.global.num_terms = static_cast<int>(direction_.size());
  for (int t = 0; t < matrices.global.num_terms; ++t) {
    const auto k = static_cast<std::size_t>(t);
    if constexpr (sizeof(H) == sizeof(double)) {
      matrices.global.direction[t] = direction_[k].data();
    } else {
      matrices.global.direction[t] = direction_float_[k].data();
    }
    for (int u = 0; u < matrices.global.num_terms; ++u) matrices.global.weight[t][u] = static_cast<H>(weight_(t, u));
  }
  return matrices;
}

template StepMatrices<double> StepFactors::view() const;
template StepMatrices<float> StepFactors::view() const;

LineageFactors::LineageFactors(const Model& model, std::span<const int> order, double time_step, double beta)
    : time_step_(time_step),
      beta_(beta),
      damped_mass_(
          reordered(time_step * beta * model.weight + inertia_and_patches(model.solid_masses(), {}, 1), order, 1), 1) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> weight = reordered(model.weight, order, 1);
  row_start_.push_back(0);
  for (Eigen::Index i = 0; i < weight.rows(); ++i) {
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(weight, i); entry; ++entry) {
      column_.push_back(static_cast<int>(entry.col()));
      weight_.push_back(entry.value());
    }
    row_start_.push_back(static_cast<int>(column_.size()));
  }
  weight_float_.assign(weight_.begin(), weight_.end());
}

LineageMatrices<double> LineageFactors::view(double) const {
  return {row_start_.data(), column_.data(), weight_.data(), damped_mass_.view(0.0)};
}
LineageMatrices<float> LineageFactors::view(float) const {
  return {row_start_.data(), column_.data(), weight_float_.data(), damped_mass_.view(0.0F)};
}

}  // namespace npfem::cpu
