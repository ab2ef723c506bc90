// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/cpu/step_task.h"

namespace npfem::cpu {

/// A factor N = L D L^T in the form in which the kernels read it, in double and in float. Serves all cells of a model.
class SharedFactor {
 public:
  /// `matrix`: (block_size n) x (block_size n), symmetric positive definite, in an order of elimination; block_size 1
  /// or 3. Where `solved` is given, its columns b become N^-1 b. Throws Error(bad_input) where N is not positive
  /// definite.
  SharedFactor(const Eigen::SparseMatrix<double>& matrix, int block_size, Eigen::MatrixXd* solved = nullptr);

  FactorView<double> view(double) const;
  FactorView<float> view(float) const;
  /// Whether the factor in float is finite and positive definite like that in double.
  bool fits_float() const { return fits_float_; }

 private:
  void transpose();
  bool is_sound_in_float() const;

  int block_size_;
  bool fits_float_;
  std::vector<int> row_start_, column_, back_start_, back_column_;
  std::vector<double> value_, back_value_, inverse_diagonal_;
  std::vector<float> value_float_, back_value_float_, inverse_diagonal_float_;
};

/// The order in which vertices are eliminated with little fill (approximate minimum degree; Amestoy, Davis & Duff
/// 1996): position k of the order is vertex order[k].
std::vector<int> elimination_order(const Eigen::SparseMatrix<double>& pattern);

/// The inverse of an order: vertex v has place places_in(order)[v].
std::vector<int> places_in(std::span<const int> order);

/// `matrix`, rows and columns of `block_size` coordinates each, with its vertices in the given order.
Eigen::SparseMatrix<double> reordered(const Eigen::SparseMatrix<double>& matrix, std::span<const int> order,
                                      int block_size);

}  // namespace npfem::cpu
