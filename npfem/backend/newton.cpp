// SPDX-License-Identifier: MPL-2.0
#include "backend/newton.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "backend/inertia_and_patches.h"
#include "backend/reference/line_search.h"
#include "model/hessian.h"

namespace npfem {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

Eigen::Map<const Eigen::VectorXd> flat(const VertexField& field) {
  return {field.data(), field.size()};
}

/// The second derivative of the objective at one point after the other, factorised. All have the same non-zero entries,
/// so their elimination order is found once.
class NewtonFactor {
 public:
  explicit NewtonFactor(const StepObjective& objective)
      : objective_(objective),
        constant_(inertia_and_patches(objective.inertia, objective.patches, 3)),
        identity_(constant_.rows(), constant_.cols()),
        unit_(objective.model.weight.diagonal().mean() + objective.inertia.mean()) {
    identity_.setIdentity();
  }

  /// A positive definite matrix for the next step: the exact second derivative, with `damping` (in units of the mean
  /// diagonal) on its diagonal; where a few directions curve downward, with what lifts just these, so that the step
  /// leaves a saddle quickly; the projected one where many do. False where none is definite.
  bool prepare(const VertexField& displacement, double damping) {
    constexpr int few = 8;
    assemble(displacement, Definite::exact);
    for (double lift = damping; lift < 0.5; lift = std::max(4 * lift, 1e-4)) {
      const Eigen::Index downward = factorise(lift);
      if (downward == 0) return true;
      if (downward > few) break;
    }
    assemble(displacement, Definite::projected);
    return factorise(damping) == 0;
  }

  /// - H^-1 gradient, where H = S + D diag(k) D^T: S^-1 g less its part along S^-1 D (Sherman, Morrison, Woodbury).
  VertexField direction(const VertexField& gradient) const {
    Eigen::VectorXd y = factor_.solve(flat(gradient));
    if (dense_.cols() > 0) y -= solved_dense_ * capacitance_.solve(dense_.transpose() * y);
    return -Eigen::Map<const VertexField>(y.data(), gradient.rows(), 3);
  }

 private:
  void assemble(const VertexField& displacement, Definite definite) {
    const VertexField x = objective_.start + displacement;
    const std::span<const double> positions(x.data(), static_cast<std::size_t>(x.size()));
    matrix_ = elastic_hessian(objective_.model, positions, definite) + constant_;
    matrix_ += objective_.dissipation.hessian(displacement, definite);
    take_dense_parts(global_stiffness(objective_.model, positions));
  }

  /// Returns the number of directions in which H curves downward.
  Eigen::Index factorise(double damping) {
    const SparseMatrix damped = matrix_ + damping * unit_ * identity_;
    if (!ordered_) factor_.analyzePattern(damped);
    ordered_ = true;
    factor_.factorize(damped);
    if (factor_.info() != Eigen::Success) return damped.rows();
    // The dense parts may hold what the sparse one lets go: a cell under tension that only its volume keeps from
    // pinching. The negative directions of C = K^-1 + D^T S^-1 D are those of S that D holds (Haynsworth's formula).
    return negatives(factor_.vectorD()) - factorise_capacitance();
  }

  static Eigen::Index negatives(const Eigen::VectorXd& values) { return (!(values.array() > 0)).count(); }

  void take_dense_parts(const std::vector<GlobalStiffness>& parts) {
    dense_.resize(constant_.rows(), static_cast<Eigen::Index>(parts.size()));
    compliance_.resize(dense_.cols());
    for (Eigen::Index i = 0; i < dense_.cols(); ++i) {
      dense_.col(i) = parts[static_cast<std::size_t>(i)].direction;
      compliance_(i) = 1 / parts[static_cast<std::size_t>(i)].stiffness;
    }
  }

  /// C, and the number of its negative directions.
  Eigen::Index factorise_capacitance() {
    if (dense_.cols() == 0) return 0;
    solved_dense_ = factor_.solve(dense_);
    Eigen::MatrixXd capacitance = dense_.transpose() * solved_dense_;
    capacitance += compliance_.asDiagonal();
    capacitance_.compute(capacitance);
    return negatives(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(capacitance).eigenvalues());
  }

  const StepObjective& objective_;
  SparseMatrix constant_, identity_, matrix_;
  double unit_;  ///< pN/um
  bool ordered_ = false;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
  Eigen::MatrixXd dense_, solved_dense_;
  Eigen::VectorXd compliance_;
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
      value_ = std::max(100 * value_, 1e-4);
    }
    stalls_ = step < 1e-3 ? stalls_ + 1 : 0;
  }
  /// No damping helps: the minimum lies on a kink, or the forces are the gradient of no energy (lineage volume).
  bool exhausted() const { return stalls_ >= 4; }

 private:
  static constexpr double least = 1e-9;
  double value_ = least;
  int stalls_ = 0;
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
    if (factor.prepare(here.displacement, damping.value())) {
      search = line_search(objective, here, factor.direction(here.gradient), options.max_line_search, next);
    }
    report.evaluations += search.evaluations;
    damping.learn(search.step);
    if (search.step > 0) std::swap(here, next);
    if (damping.exhausted()) {
      report.residual = here.residual();
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
