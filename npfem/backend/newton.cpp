// SPDX-License-Identifier: MPL-2.0
#include "backend/newton.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "backend/reference/line_search.h"
#include "model/hessian.h"

namespace npfem {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

Eigen::Map<const Eigen::VectorXd> flat(const VertexField& field) {
  return {field.data(), field.size()};
}

/// What the objective adds to the elastic second derivative and what does not depend on the shape: inertia, and the
/// springs that tie a patch together.
SparseMatrix constant_stiffness(const StepObjective& objective) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j, double stiffness) {
    for (int axis = 0; axis < 3; ++axis) entries.emplace_back(3 * i + axis, 3 * j + axis, stiffness);
  };
  for (int i = 0; i < objective.model.num_vertices(); ++i) add(i, i, objective.inertia(i));
  for (const Patch& patch : objective.patches) {
    const double share = patch.stiffness / static_cast<double>(patch.vertices.size());
    for (const int i : patch.vertices) {
      add(i, i, patch.stiffness);
      for (const int j : patch.vertices) add(i, j, -share);
    }
  }
  const Eigen::Index n = 3 * objective.model.num_vertices();
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The second derivative of the objective at one point after the other, factorised. All have the same non-zero entries,
/// so their elimination order is found once.
class NewtonFactor {
 public:
  explicit NewtonFactor(const StepObjective& objective)
      : objective_(objective),
        constant_(constant_stiffness(objective)),
        identity_(constant_.rows(), constant_.cols()),
        unit_(objective.model.weight.diagonal().mean() + objective.inertia.mean()) {
    identity_.setIdentity();
  }

  /// `damping`: added to the diagonal, in units of its mean. False where the matrix is not positive definite.
  bool factorise(const VertexField& displacement, Definite definite, double damping) {
    const VertexField x = objective_.start + displacement;
    const std::span<const double> positions(x.data(), static_cast<std::size_t>(x.size()));
    const SparseMatrix matrix =
        elastic_hessian(objective_.model, positions, definite) + constant_ + damping * unit_ * identity_;
    if (!ordered_) factor_.analyzePattern(matrix);
    ordered_ = true;
    factor_.factorize(matrix);
    if (factor_.info() != Eigen::Success) return false;
    // The dense parts may hold what the sparse one lets go: a cell under tension that only its volume keeps from
    // pinching. Each negative direction of S must be one of C = K^-1 + D^T S^-1 D too (Haynsworth's inertia formula).
    return negatives(factor_.vectorD()) == take_dense_parts(global_stiffness(objective_.model, positions));
  }

  /// - H^-1 gradient, where H = S + D diag(k) D^T: S^-1 g less its part along S^-1 D (Sherman, Morrison, Woodbury).
  VertexField direction(const VertexField& gradient) const {
    Eigen::VectorXd y = factor_.solve(flat(gradient));
    if (dense_.cols() > 0) y -= solved_dense_ * capacitance_.solve(dense_.transpose() * y);
    return -Eigen::Map<const VertexField>(y.data(), gradient.rows(), 3);
  }

 private:
  static Eigen::Index negatives(const Eigen::VectorXd& values) { return (!(values.array() > 0)).count(); }

  /// Returns the number of negative directions of C.
  Eigen::Index take_dense_parts(const std::vector<GlobalStiffness>& parts) {
    const auto count = static_cast<Eigen::Index>(parts.size());
    dense_.resize(constant_.rows(), count);
    if (count == 0) return 0;
    Eigen::VectorXd compliance(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const GlobalStiffness& part = parts[static_cast<std::size_t>(i)];
      dense_.col(i) = part.direction;
      compliance(i) = 1 / part.stiffness;
    }
    solved_dense_ = factor_.solve(dense_);
    Eigen::MatrixXd capacitance = dense_.transpose() * solved_dense_;
    capacitance += compliance.asDiagonal();
    capacitance_.compute(capacitance);
    return negatives(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(capacitance).eigenvalues());
  }

  const StepObjective& objective_;
  SparseMatrix constant_, identity_;
  double unit_;  ///< pN/um
  bool ordered_ = false;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
  Eigen::MatrixXd dense_, solved_dense_;
  Eigen::PartialPivLU<Eigen::MatrixXd> capacitance_;
};

/// How much is added to the diagonal: a little always, for the rigid motions that a static equilibrium does not resist,
/// and more after steps that the line search had to cut.
class Damping {
 public:
  double value() const { return value_; }
  void learn(double step) {
    if (step >= 1) {
      value_ = std::max(0.1 * value_, least);
    } else if (step < 0.1) {
      value_ = std::max(10 * value_, 1e-4);
    }
  }
  bool exhausted() const { return value_ > 1e4; }

 private:
  static constexpr double least = 1e-9;
  double value_ = least;
};

}  // namespace

CellReport newton_minimise(const StepObjective& objective, const SolverOptions& options, const MinimiseLimits& limits,
                           VertexField& displacement, VertexField& gradient) {
  CellReport report;
  report.tolerance = limits.tolerance;
  Trial here, next;
  here.displacement = displacement;
  here.evaluate(objective);
  report.evaluations = 1;
  if (!here.finite()) {
    report.status = CellStatus::not_finite;
    return report;
  }
  NewtonFactor factor(objective);
  Damping damping;
  report.status = CellStatus::converged;
  while ((report.residual = here.residual()) > limits.tolerance) {
    if (report.iterations == limits.iterations) {
      report.status = ended_short(report.residual, options, CellStatus::not_converged);
      break;
    }
    ++report.iterations;
    LineSearch search{0, 0};
    if (factor.factorise(here.displacement, Definite::exact, damping.value()) ||
        factor.factorise(here.displacement, Definite::projected, damping.value())) {
      search = line_search(objective, here, factor.direction(here.gradient), options.max_line_search, next);
    }
    report.evaluations += search.evaluations;
    damping.learn(search.step);
    if (search.step > 0) {
      std::swap(here, next);
    } else if (damping.exhausted()) {
      report.status = ended_short(report.residual, options, CellStatus::no_descent);
      break;
    }
  }
  displacement = here.displacement;
  gradient = here.gradient;
  return report;
}

void finish_by_newton(const StepObjective& objective, const SolverOptions& options, VertexField& displacement,
                      VertexField& gradient, CellReport& report) {
  const bool short_of_tolerance = report.status != CellStatus::converged && report.status != CellStatus::not_finite;
  if (!short_of_tolerance || options.newton_iterations == 0) return;
  const CellReport before = report;
  report = newton_minimise(objective, options, {options.newton_iterations, before.tolerance}, displacement, gradient);
  report.iterations += before.iterations;
  report.evaluations += before.evaluations;
}

}  // namespace npfem
