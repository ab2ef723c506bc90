// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/shared_factor.h"

#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "backend/reference/step_factor.h"

namespace npfem::cpu {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// The block L_ij of the scalar unit-lower factor, D of the scalar factor taken into the diagonal blocks:
/// N = (L B^-1) (B D B^T) (L B^-1)^T with B the diagonal blocks of L.
struct BlockRows {
  std::vector<std::map<int, Eigen::Matrix3d>> below;  // by row, then by column
  std::vector<Eigen::Matrix3d> diagonal;              // B
};

BlockRows block_rows(const Sparse& lower, int n) {
  BlockRows rows;
  rows.below.resize(static_cast<std::size_t>(n));
  rows.diagonal.assign(static_cast<std::size_t>(n), Eigen::Matrix3d::Identity());
  for (int column = 0; column < lower.outerSize(); ++column) {
    for (Sparse::InnerIterator entry(lower, column); entry; ++entry) {
      const auto row = static_cast<int>(entry.row());
      const int i = row / 3, j = column / 3;
      if (i == j) {
        rows.diagonal[static_cast<std::size_t>(i)](row % 3, column % 3) = entry.value();
      } else {
        auto& blocks = rows.below[static_cast<std::size_t>(i)];
        const auto at = blocks.try_emplace(j, Eigen::Matrix3d::Zero()).first;
        at->second(row % 3, column % 3) = entry.value();
      }
    }
  }
  return rows;
}

void push_rowwise(std::vector<double>& to, const Eigen::Matrix3d& m) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) to.push_back(m(r, c));
  }
}

}  // namespace

SharedFactor::SharedFactor(const Sparse& matrix, int block_size, Eigen::MatrixXd* solved) : block_size_(block_size) {
  Factor factor;
  factor.compute(matrix);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0)) refuse_step_matrix();
  if (solved) *solved = factor.solve(*solved).eval();
  const auto n = static_cast<int>(matrix.rows()) / block_size;
  const Sparse lower = factor.matrixL();
  row_start_.push_back(0);
  if (block_size == 1) {
    const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = lower;
    for (int i = 0; i < n; ++i) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(rows, i); entry; ++entry) {
        if (entry.col() >= i) continue;
        column_.push_back(static_cast<int>(entry.col()));
        value_.push_back(entry.value());
      }
      row_start_.push_back(static_cast<int>(column_.size()));
      inverse_diagonal_.push_back(1 / factor.vectorD()(i));
    }
  } else {
    const BlockRows rows = block_rows(lower, n);
    for (int i = 0; i < n; ++i) {
      for (const auto& [j, block] : rows.below[static_cast<std::size_t>(i)]) {
        column_.push_back(j);
        push_rowwise(value_, block * rows.diagonal[static_cast<std::size_t>(j)].inverse());
      }
      row_start_.push_back(static_cast<int>(column_.size()));
      const Eigen::Matrix3d inverse = rows.diagonal[static_cast<std::size_t>(i)].inverse();
      const Eigen::Vector3d d = factor.vectorD().segment<3>(3 * i).cwiseInverse();
      push_rowwise(inverse_diagonal_, inverse.transpose() * d.asDiagonal() * inverse);
    }
  }
  transpose();
  value_float_.assign(value_.begin(), value_.end());
  back_value_float_.assign(back_value_.begin(), back_value_.end());
  inverse_diagonal_float_.assign(inverse_diagonal_.begin(), inverse_diagonal_.end());
  fits_float_ = is_sound_in_float();
}

bool SharedFactor::is_sound_in_float() const {
  const auto finite = [](float v) { return std::isfinite(v); };
  if (!std::all_of(value_float_.begin(), value_float_.end(), finite)) return false;
  const auto size = static_cast<std::size_t>(block_size_ * block_size_);
  for (std::size_t k = 0; k < inverse_diagonal_float_.size(); k += size) {
    using Block = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
    const Eigen::MatrixXd inverse = Block(inverse_diagonal_float_.data() + k, block_size_, block_size_).cast<double>();
    const double least = inverse.diagonal().minCoeff();
    if (!inverse.allFinite() || !(least >= std::numeric_limits<float>::min())) return false;
    if (inverse.llt().info() != Eigen::Success) return false;
  }
  return true;
}

/// L^T by rows, its blocks transposed.
void SharedFactor::transpose() {
  const auto n = row_start_.size() - 1, size = static_cast<std::size_t>(block_size_);
  back_start_.assign(n + 1, 0);
  for (const int column : column_) ++back_start_[static_cast<std::size_t>(column) + 1];
  for (std::size_t i = 0; i < n; ++i) back_start_[i + 1] += back_start_[i];
  back_column_.resize(column_.size());
  back_value_.resize(value_.size());
  std::vector<int> next(back_start_.begin(), back_start_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (auto k = static_cast<std::size_t>(row_start_[i]); k < static_cast<std::size_t>(row_start_[i + 1]); ++k) {
      const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(column_[k])]++);
      back_column_[at] = static_cast<int>(i);
      for (std::size_t r = 0; r < size; ++r) {
        for (std::size_t c = 0; c < size; ++c)
          back_value_[(at * size + r) * size + c] = value_[(k * size + c) * size + r];
      }
    }
  }
}

FactorView<double> SharedFactor::view(double) const {
  return {row_start_.data(),   column_.data(),     value_.data(),           back_start_.data(),
          back_column_.data(), back_value_.data(), inverse_diagonal_.data()};
}
FactorView<float> SharedFactor::view(float) const {
  return {row_start_.data(),   column_.data(),           value_float_.data(),           back_start_.data(),
          back_column_.data(), back_value_float_.data(), inverse_diagonal_float_.data()};
}

std::vector<int> places_in(std::span<const int> order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  return place;
}

std::vector<int> elimination_order(const Sparse& pattern) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
  Eigen::AMDOrdering<int> ordering;
  const Sparse symmetric = pattern;
  ordering(symmetric, inverse);
  return {inverse.indices().data(), inverse.indices().data() + inverse.indices().size()};
}

Sparse reordered(const Sparse& matrix, std::span<const int> order, int block_size) {
  const std::vector<int> place = places_in(order);
  const auto moved = [&](Eigen::Index i) {
    const auto vertex = static_cast<std::size_t>(i / block_size);
    return place[vertex] * block_size + static_cast<int>(i % block_size);
  };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      entries.emplace_back(moved(entry.row()), moved(entry.col()), entry.value());
  }
  Sparse result(matrix.rows(), matrix.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace npfem::cpu
