// SPDX-License-Identifier: MPL-2.0
// The second derivative against central differences of the gradient, and what must hold of it whatever the shape.
#include "model/hessian.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "backend/reference/elasticity.h"
#include "cells.h"
#include "random_shape.h"
#include "sample_params.h"

namespace npfem {
namespace {

using testing::Random;

VertexField field(const std::vector<double>& x) {
  return Eigen::Map<const VertexField>(x.data(), static_cast<Eigen::Index>(x.size() / 3), 3);
}

std::vector<double> positions(const Model& model, double noise, unsigned seed) {
  Random random(seed);
  std::vector<double> x;
  for (const Point& p : model.initial) {
    for (const double c : p) x.push_back(c + random(-noise, noise));
  }
  return x;
}

Eigen::VectorXd gradient(const Model& model, const std::vector<double>& x) {
  VertexField g = VertexField::Zero(static_cast<Eigen::Index>(x.size() / 3), 3);
  elastic_energy(model, field(x), g);
  return Eigen::Map<const Eigen::VectorXd>(g.data(), g.size());
}

Eigen::MatrixXd by_differences(const Model& model, std::vector<double> x) {
  const double h = 1e-5;
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd hessian(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double& moving = x[static_cast<std::size_t>(i)];
    const double at = moving;
    moving = at + h;
    const Eigen::VectorXd above = gradient(model, x);
    moving = at - h;
    hessian.col(i) = (above - gradient(model, x)) / (2 * h);
    moving = at;
  }
  return hessian;
}

Eigen::MatrixXd whole(const Model& model, const std::vector<double>& x) {
  Eigen::MatrixXd hessian = elastic_hessian(model, x, Definite::exact);
  for (const GlobalStiffness& part : global_stiffness(model, x)) {
    hessian += part.stiffness * part.direction * part.direction.transpose();
  }
  return hessian;
}

double largest(const Eigen::MatrixXd& m) {
  return m.cwiseAbs().maxCoeff();
}

/// One element alone, on `x` when at rest.
template <class E>
Model one_element(Random& random) {
  constexpr int n = E::num_vertices;
  Vec3<double> rest[n];
  testing::random_element(random, 0.15, rest);
  Model model;
  auto& block = model.block<E>();
  std::array<int, n> ids;
  for (int i = 0; i < n; ++i) {
    ids[static_cast<std::size_t>(i)] = i;
    model.initial.push_back({rest[i].x, rest[i].y, rest[i].z});
  }
  block.vertices.push_back(ids);
  block.params.push_back(testing::sample_params<E>());
  block.rest.push_back(E::rest(rest, block.params[0]));
  for (Point& p : model.initial) {
    for (double& c : p) c *= testing::sample_squeeze<E>;
  }
  return model;
}

template <class List>
struct GoogleTypes;
template <class... Es>
struct GoogleTypes<TypeList<Es...>> {
  using type = ::testing::Types<Es...>;
};
template <class E>
class ElementHessian : public ::testing::Test {};
TYPED_TEST_SUITE(ElementHessian, GoogleTypes<ElementEnergies>::type);

/// Energies that are convex: nothing of theirs is ever projected away.
template <class E>
constexpr bool is_convex = std::is_same_v<E, ParallelogramShape> || std::is_same_v<E, Closeness>;

TYPED_TEST(ElementHessian, EqualsDifferencesOfTheGradient) {
  // A projection of four Newton steps has a derivative one step less converged than its value.
  constexpr bool lags = std::is_same_v<TypeParam, Tetrahedron<TetrahedronVolume>>;
  const double displacement = (lags ? 0.3 : 1.0) * testing::sample_displacement<TypeParam>;
  Random random(11);
  for (unsigned k = 0; k < 20; ++k) {
    const Model model = one_element<TypeParam>(random);
    const auto x = positions(model, displacement, k);
    const Eigen::MatrixXd exact = elastic_hessian(model, x, Definite::exact);
    EXPECT_LT(largest(exact - by_differences(model, x)), 1e-5 * largest(exact));
    EXPECT_GT(largest(exact), 1e-3) << "a test on zeros proves nothing";
  }
}

TYPED_TEST(ElementHessian, ProjectedKeepsWhatCurvesUpward) {
  Random random(12);
  int indefinite = 0;
  for (unsigned k = 0; k < 20; ++k) {
    const Model model = one_element<TypeParam>(random);
    const auto x = positions(model, 0.3 * testing::sample_squeeze<TypeParam>, k);
    const Eigen::MatrixXd exact = elastic_hessian(model, x, Definite::exact);
    const Eigen::MatrixXd projected = elastic_hessian(model, x, Definite::projected);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> before(exact), after(projected), change(projected - exact);
    const double size = largest(exact);
    EXPECT_GT(after.eigenvalues()(0), -1e-12 * size);
    EXPECT_GT(change.eigenvalues()(0), -1e-12 * size) << "a projection only ever adds stiffness";
    EXPECT_LT((after.eigenvalues() - before.eigenvalues().cwiseMax(0)).cwiseAbs().maxCoeff(), 1e-12 * size);
    indefinite += before.eigenvalues()(0) < -1e-6 * size ? 1 : 0;
  }
  EXPECT_EQ(indefinite > 0, !is_convex<TypeParam>);
}

/// Cells of both kinds of material; the energies on the whole cell are part of each.
class CellHessian : public ::testing::TestWithParam<const char*> {
 protected:
  static Model cell(double stress_free_reduced_volume) {
    Material material = Material::preset(GetParam());
    material.set("stress_free_reduced_volume", stress_free_reduced_volume);
    return build_model(evans_fung_cell(2), material);
  }
};
INSTANTIATE_TEST_SUITE_P(Materials, CellHessian, ::testing::Values("rbc", "palabos-rbc"),
                         [](const auto& material) { return std::string(material.param) == "rbc" ? "Rbc" : "Lineage"; });

TEST_P(CellHessian, EqualsDifferencesOfTheGradient) {
  Model model = cell(0);
  // The lineage's volume force is the gradient of no energy: its derivative by the volume is tested apart, below.
  cell_term<LineageVolume>(model).reset();
  cell_term<GlobalVolume>(model).emplace(GlobalVolume::Params<double>{2000});
  cell_term<GlobalArea>(model).emplace(GlobalArea::Params<double>{2500});
  const auto x = positions(model, 0.02, 5);
  const Eigen::MatrixXd hessian = whole(model, x);
  EXPECT_LT(largest(hessian - by_differences(model, x)), 1e-6 * largest(hessian));
  EXPECT_LT(largest(hessian - hessian.transpose()), 1e-14 * largest(hessian));
  EXPECT_EQ(global_stiffness(model, x).size(), 2u);
}

TEST_P(CellHessian, ProjectedIsSemidefiniteAndExactAtAStressFreeShape) {
  const Model model = cell(0);
  const auto rest = positions(model, 0, 0), moved = positions(model, 0.1, 6);
  const Eigen::MatrixXd exact = elastic_hessian(model, rest, Definite::exact);
  EXPECT_LT(largest(elastic_hessian(model, rest, Definite::projected) - exact), 1e-9 * largest(exact));
  const Eigen::MatrixXd projected = elastic_hessian(model, moved, Definite::projected);
  const Eigen::MatrixXd raw = elastic_hessian(model, moved, Definite::exact);
  const double size = largest(projected);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected).eigenvalues()(0), -1e-12 * size);
  EXPECT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(raw).eigenvalues()(0), -1e-4 * size);
}

TEST_P(CellHessian, FeelsNoRigidMotionAndNothingElseAtRest) {
  const Model model = cell(0);
  const auto x = positions(model, 0, 0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(whole(model, x));
  const Eigen::VectorXd& k = modes.eigenvalues();
  const double size = k(k.size() - 1);
  for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(k(i)), 1e-10 * size);
  EXPECT_GT(k(6), 1e-8 * size);
  const auto n = static_cast<Eigen::Index>(x.size());
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(n), turn = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; i += 3) {
      const auto k0 = static_cast<std::size_t>(i);
      shift(i + axis) = 1;
      turn(i + (axis + 1) % 3) = -x[k0 + static_cast<std::size_t>((axis + 2) % 3)];
      turn(i + (axis + 2) % 3) = x[k0 + static_cast<std::size_t>((axis + 1) % 3)];
    }
    EXPECT_LT((whole(model, x) * shift).cwiseAbs().maxCoeff(), 1e-11 * size);
    EXPECT_LT((whole(model, x) * turn).cwiseAbs().maxCoeff(), 1e-9 * size);
  }
}

TEST(GlobalStiffness, LineageVolumeIsASpringOnTheVolume) {
  Model model = build_model(evans_fung_cell(2), Material::preset("palabos-rbc"));
  const auto x = positions(model, 0.05, 8);
  const auto parts = global_stiffness(model, x);
  ASSERT_EQ(parts.size(), 1u);
  VertexField by_area(model.num_vertices(), 3), by_volume(model.num_vertices(), 3);
  const auto sums = surface_sums(model, field(x), by_area, by_volume);
  const double weight = cell_term<LineageVolume>(model)->weight;
  EXPECT_NEAR(parts[0].stiffness, weight / sums.volume_gradient_square, 1e-12 * parts[0].stiffness);
  EXPECT_LT((parts[0].direction - Eigen::Map<Eigen::VectorXd>(by_volume.data(), by_volume.size())).norm(), 1e-12);
}

}  // namespace
}  // namespace npfem
