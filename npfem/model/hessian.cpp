// SPDX-License-Identifier: MPL-2.0
#include "model/hessian.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "energies/dual.h"

namespace npfem {
namespace {

Vec3<double> vertex(std::span<const double> x, int i) {
  const double* p = x.data() + 3 * static_cast<std::size_t>(i);
  return {p[0], p[1], p[2]};
}

double& coordinate(Vec3<double>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
Dual& coordinate(Vec3<Dual>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// `matrix` without its downward curvature: the nearest positive-semidefinite one.
void project(Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  if (!(eigen.eigenvalues()(0) < 0)) return;
  const Eigen::VectorXd kept = eigen.eigenvalues().cwiseMax(0);
  matrix = eigen.eigenvectors() * kept.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Collects the 3k x 3k blocks of elements of k vertices.
class Assembler {
 public:
  Assembler(std::span<const double> x, Definite definite) : x_(x), definite_(definite) {}

  /// Adds d(gradient)/dx of one element. `gradient(corners, slopes)` fills the k slopes from the k corners, on duals.
  template <class Gradient>
  void add(std::span<const int> vertices, Gradient&& gradient) {
    const std::size_t k = vertices.size();
    corners_.resize(k);
    slopes_.resize(k);
    for (std::size_t i = 0; i < k; ++i) {
      const Vec3<double> at = vertex(x_, vertices[i]);
      corners_[i] = {at.x, at.y, at.z};
    }
    block_.resize(static_cast<Eigen::Index>(3 * k), static_cast<Eigen::Index>(3 * k));
    for (Eigen::Index column = 0; column < block_.cols(); ++column) {
      Dual& moving = coordinate(corners_[static_cast<std::size_t>(column / 3)], static_cast<int>(column % 3));
      moving.slope = 1;
      gradient(corners_.data(), slopes_.data());
      moving.slope = 0;
      for (Eigen::Index row = 0; row < block_.rows(); ++row) {
        block_(row, column) = coordinate(slopes_[static_cast<std::size_t>(row / 3)], static_cast<int>(row % 3)).slope;
      }
    }
    block_ = 0.5 * (block_ + block_.transpose()).eval();
    if (definite_ == Definite::projected) project(block_);
    for (Eigen::Index row = 0; row < block_.rows(); ++row) {
      for (Eigen::Index column = 0; column < block_.cols(); ++column) {
        entries_.emplace_back(3 * vertices[static_cast<std::size_t>(row / 3)] + static_cast<int>(row % 3),
                              3 * vertices[static_cast<std::size_t>(column / 3)] + static_cast<int>(column % 3),
                              block_(row, column));
      }
    }
  }

  Eigen::SparseMatrix<double> matrix() const {
    const auto n = static_cast<Eigen::Index>(x_.size());
    Eigen::SparseMatrix<double> sum(n, n);
    sum.setFromTriplets(entries_.begin(), entries_.end());
    return sum;
  }

 private:
  std::span<const double> x_;
  Definite definite_;
  std::vector<Vec3<Dual>> corners_, slopes_;
  Eigen::MatrixXd block_;
  std::vector<Eigen::Triplet<double>> entries_;
};

template <class E>
void add_elements(const ElementBlock<E>& block, Assembler& assembler) {
  for (std::size_t e = 0; e < block.size(); ++e) {
    assembler.add(block.vertices[e], [&](const Vec3<Dual>* corners, Vec3<Dual>* slopes) {
      Vec3<Dual> x[E::num_vertices], gradient[E::num_vertices];
      std::copy_n(corners, E::num_vertices, x);
      E::energy_gradient(x, block.rest[e], block.params[e], gradient);
      std::copy_n(gradient, E::num_vertices, slopes);
    });
  }
}

/// Area of a triangle, and its gradient.
template <class T>
T area_gradient(const Vec3<T>* x, Vec3<T>* gradient) {
  const Vec3<T> normal = cross(x[1] - x[0], x[2] - x[0]);
  const T twice_area = norm(normal);
  const Vec3<T> half_unit_normal = (0.5 / larger(twice_area, T(1e-30))) * normal;
  for (int i = 0; i < 3; ++i) gradient[i] = cross(half_unit_normal, x[(i + 2) % 3] - x[(i + 1) % 3]);
  return 0.5 * twice_area;
}

/// What a triangle adds to the enclosed volume's gradient: a third of its area vector at each vertex. Exact in the sum
/// over a closed surface, and blind to where the origin is.
template <class T>
void volume_gradient(const Vec3<T>* x, Vec3<T>* gradient) {
  const Vec3<T> share = (1.0 / 6) * cross(x[1] - x[0], x[2] - x[0]);
  for (int i = 0; i < 3; ++i) gradient[i] = share;
}

struct SurfaceShape {
  CellSums<double> sums;
  Eigen::VectorXd by_area, by_volume;  ///< dA/dx (um), dV/dx (um^2)
};

SurfaceShape surface_shape(const Model& model, std::span<const double> x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  SurfaceShape shape{{0, 0, 0}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const Vec3<double> origin = vertex(x, 0);
  for (const Triangle& t : model.triangles) {
    Vec3<double> corner[3], area_slope[3], volume_slope[3];
    for (std::size_t i = 0; i < 3; ++i) corner[i] = vertex(x, t[i]) - origin;
    shape.sums.area += area_gradient(corner, area_slope);
    volume_gradient(corner, volume_slope);
    shape.sums.volume += dot(corner[0] + corner[1] + corner[2], volume_slope[0]) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        shape.by_area(3 * t[i] + axis) += coordinate(area_slope[i], axis);
        shape.by_volume(3 * t[i] + axis) += coordinate(volume_slope[i], axis);
      }
    }
  }
  shape.sums.volume_gradient_square = shape.by_volume.squaredNorm();
  return shape;
}

/// Calls f(params, E) for each energy of the whole cell that the model has.
template <class F>
void for_each_cell_term(const Model& model, F&& f) {
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (const auto& params = cell_term<E>(model)) f(*params, tag);
  });
}

/// The terms that come from the curvature of area and volume themselves.
void add_surface_curvature(const Model& model, const CellSums<double>& sums, Assembler& assembler) {
  double tension = 0, pressure = 0;  // dE/dA, pN/um, and dE/dV, Pa
  for_each_cell_term(model, [&](const auto& params, auto tag) {
    const auto response = decltype(tag)::type::respond(sums, model.rest, params);
    tension += response.by_area;
    pressure += response.by_volume;
  });
  for (const Triangle& t : model.triangles) {
    assembler.add(t, [&](const Vec3<Dual>* corners, Vec3<Dual>* slopes) {
      Vec3<Dual> by_area[3], by_volume[3];
      area_gradient(corners, by_area);
      volume_gradient(corners, by_volume);
      for (int i = 0; i < 3; ++i) slopes[i] = tension * by_area[i] + pressure * by_volume[i];
    });
  }
}

}  // namespace

Eigen::SparseMatrix<double> elastic_hessian(const Model& model, std::span<const double> x, Definite definite) {
  Assembler assembler(x, definite);
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    add_elements(model.block<E>(), assembler);
  });
  if (model.has_cell_terms()) add_surface_curvature(model, surface_shape(model, x).sums, assembler);
  return assembler.matrix();
}

std::vector<GlobalStiffness> global_stiffness(const Model& model, std::span<const double> x) {
  std::vector<GlobalStiffness> parts;
  if (!model.has_cell_terms()) return parts;
  const SurfaceShape shape = surface_shape(model, x);
  double by_area = 0, by_volume = 0;
  for_each_cell_term(model, [&](const auto& params, auto tag) {
    using E = typename decltype(tag)::type;
    CellSums<Dual> sums{shape.sums.area, shape.sums.volume, shape.sums.volume_gradient_square};
    sums.area.slope = 1;
    by_area += E::respond(sums, model.rest, params).by_area.slope;
    sums.area.slope = 0;
    sums.volume.slope = 1;
    by_volume += E::respond(sums, model.rest, params).by_volume.slope;
  });
  if (by_area != 0) parts.push_back({shape.by_area, by_area});
  if (by_volume != 0) parts.push_back({shape.by_volume, by_volume});
  return parts;
}

}  // namespace npfem
