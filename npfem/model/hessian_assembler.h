// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <span>
#include <vector>

#include "energies/dual.h"
#include "energies/vec3.h"
#include "model/hessian.h"

namespace npfem {

inline Vec3<double> vertex_at(std::span<const double> x, int vertex) {
  const double* p = x.data() + 3 * static_cast<std::size_t>(vertex);
  return {p[0], p[1], p[2]};
}

template <class T>
T& coordinate(Vec3<T>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Sums the 3k x 3k second derivatives of elements of k vertices, each by one evaluation of its gradient on duals per
/// coordinate.
class HessianAssembler {
 public:
  HessianAssembler(std::span<const double> x, Definite definite) : x_(x), definite_(definite) {}

  /// Adds one element. `gradient(corners, slopes)` fills the k slopes from the k corners.
  template <class Gradient>
  void add(std::span<const int> vertices, Gradient&& gradient) {
    const std::size_t k = vertices.size();
    corners_.resize(k);
    slopes_.resize(k);
    for (std::size_t i = 0; i < k; ++i) {
      const Vec3<double> at = vertex_at(x_, vertices[i]);
      corners_[i] = {at.x, at.y, at.z};
    }
    const auto size = static_cast<Eigen::Index>(3 * k);
    block_.resize(size, size);
    for (Eigen::Index column = 0; column < size; ++column) {
      Dual& moving = coordinate(corners_[static_cast<std::size_t>(column / 3)], static_cast<int>(column % 3));
      moving.slope = 1;
      gradient(corners_.data(), slopes_.data());
      moving.slope = 0;
      for (Eigen::Index row = 0; row < size; ++row) {
        block_(row, column) = coordinate(slopes_[static_cast<std::size_t>(row / 3)], static_cast<int>(row % 3)).slope;
      }
    }
    add_block(vertices);
  }

  /// Adds every element of a block of one energy.
  template <class E>
  void add(const ElementBlock<E>& elements) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      add(elements.vertices[e], [&](const Vec3<Dual>* corners, Vec3<Dual>* slopes) {
        Vec3<Dual> x[E::num_vertices], gradient[E::num_vertices];
        std::copy_n(corners, E::num_vertices, x);
        E::energy_gradient(x, elements.rest[e], elements.params[e], gradient);
        std::copy_n(gradient, E::num_vertices, slopes);
      });
    }
  }

  Eigen::SparseMatrix<double> matrix() const;

 private:
  void add_block(std::span<const int> vertices);

  std::span<const double> x_;
  Definite definite_;
  std::vector<Vec3<Dual>> corners_, slopes_;
  Eigen::MatrixXd block_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace npfem
