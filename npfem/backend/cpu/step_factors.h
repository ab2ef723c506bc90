// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "backend/backend.h"
#include "backend/cpu/aligned.h"
#include "backend/cpu/shared_factor.h"

namespace npfem::cpu {

/// Second derivative of the elastic energy at the model's initial shape, made positive semidefinite, in the kernels'
/// order of vertices: the sparse part and the dense ones of rank one.
struct RestHessian {
  RestHessian(const Model& model, std::span<const int> order);

  Eigen::SparseMatrix<double> sparse;  ///< 3n x 3n, pN/um
  struct Dense {
    Eigen::VectorXd direction;
    double stiffness;
  };
  std::vector<Dense> dense;
  Eigen::SparseMatrix<double> viscous;  ///< the same of the incremental dissipation, times the step, pN us/um
};

/// What the factors of a step are made for.
struct FactorKey {
  double lead;          ///< us: inertia is M/lead^2
  int mass_set;         ///< index of the ambient masses; -1: none
  double weight_scale;  ///< of the scalar matrix: 1, or 1 + Cbeta/dt in a lineage step
  bool operator==(const FactorKey&) const = default;
};

/// The matrices of one step, factorised: shared by every cell with the same masses.
class StepFactors {
 public:
  /// `mass` per vertex of the model (fg); `hessian` null: the scalar matrix only. Throws Error(bad_input)
  /// where a matrix is not positive definite.
  StepFactors(const Model& model, std::span<const int> order, const FactorKey& key, const Eigen::VectorXd& mass,
              std::span<const Patch> patches, const RestHessian* hessian);

  const FactorKey& key() const { return key_; }
  bool has_hessian() const { return block_.has_value(); }
  bool fits_float() const { return scalar_.fits_float() && (!block_ || block_->fits_float()); }
  template <class H>
  StepMatrices<H> view() const;

 private:
  void add_block(std::span<const int> order, const Eigen::VectorXd& mass, std::span<const Patch> patches,
                 const RestHessian& hessian);

  FactorKey key_;
  SharedFactor scalar_;
  std::optional<SharedFactor> block_;
  std::vector<AlignedVector<double>> direction_;
  std::vector<AlignedVector<float>> direction_float_;
  Eigen::MatrixXd weight_;
};

/// The lineage's M~ = M + dt Cbeta W, factorised, and W itself.
class LineageFactors {
 public:
  LineageFactors(const Model& model, std::span<const int> order, double time_step, double beta);

  bool is_for(double time_step, double beta) const { return time_step_ == time_step && beta_ == beta; }
  LineageMatrices<double> view(double) const;
  LineageMatrices<float> view(float) const;

 private:
  double time_step_, beta_;
  SharedFactor damped_mass_;
  std::vector<int> row_start_, column_;
  std::vector<double> weight_;
  std::vector<float> weight_float_;
};

}  // namespace npfem::cpu
