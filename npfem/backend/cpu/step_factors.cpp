// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/step_factors.h"

#include <Eigen/Dense>

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

/// Inertia of the vertices and the springs of the patches, `copies` coordinates for each vertex.
Sparse inertia_and_patches(std::span<const double> mass, double lead, std::span<const Patch> patches,
                           std::span<const int> order, int copies) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j, double value) {
    for (int c = 0; c < copies; ++c) entries.emplace_back(copies * i + c, copies * j + c, value);
  };
  for (std::size_t k = 0; k < mass.size(); ++k) add(static_cast<int>(k), static_cast<int>(k), mass[k] / (lead * lead));
  for (const Patch& patch : patches) {
    const double share = patch.stiffness / static_cast<double>(patch.vertices.size());
    for (const int v : patch.vertices) {
      const int i = place[static_cast<std::size_t>(v)];
      add(i, i, patch.stiffness);
      for (const int w : patch.vertices) add(i, place[static_cast<std::size_t>(w)], -share);
    }
  }
  const auto size = static_cast<Eigen::Index>(mass.size()) * copies;
  Sparse matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
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
                         std::span<const double> mass, std::span<const Patch> patches, const RestHessian* hessian)
    : key_(key),
      scalar_(key.weight_scale * reordered(model.weight, order, 1) +
                  (1 / key.lead) * reordered(model.viscous_weight, order, 1) +
                  inertia_and_patches(mass, key.lead, patches, order, 1),
              1) {
  if (!hessian) return;
  block_.emplace(
      hessian->sparse + (1 / key.lead) * hessian->viscous + inertia_and_patches(mass, key.lead, patches, order, 3), 3);
  add_global_terms(*hessian);
}

/// H = S + sum_t k_t a_t a_t^T has H^-1 = S^-1 - Z C Z^T with Z = S^-1 a, C = (diag(1/k) + a^T Z)^-1.
void StepFactors::add_global_terms(const RestHessian& hessian) {
  const auto terms = static_cast<Eigen::Index>(hessian.dense.size());
  Eigen::MatrixXd capacity = Eigen::MatrixXd::Zero(terms, terms);
  std::vector<Eigen::VectorXd> z;
  for (const auto& term : hessian.dense) z.push_back(block_->solve(term.direction));
  for (Eigen::Index t = 0; t < terms; ++t) {
    const auto& term = hessian.dense[static_cast<std::size_t>(t)];
    capacity(t, t) += 1 / term.stiffness;
    for (Eigen::Index u = 0; u < terms; ++u) capacity(t, u) += term.direction.dot(z[static_cast<std::size_t>(u)]);
    // Padded with zeros to whole registers: a lone cell is read one register after the other.
    AlignedVector<double> padded(static_cast<std::size_t>(term.direction.size()) + 16, 0.0);
    std::copy_n(z[static_cast<std::size_t>(t)].data(), term.direction.size(), padded.begin());
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

LineageFactors::LineageFactors(const Model& model, std::span<const int> order, std::span<const double> solid_mass,
                               double time_step, double beta)
    : time_step_(time_step),
      beta_(beta),
      damped_mass_(
          time_step * beta * reordered(model.weight, order, 1) + inertia_and_patches(solid_mass, 1, {}, order, 1), 1) {
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
